"""Results files of CalculiX."""


def contact_field(path):
    """The last CONTACT block of a results file: by node, opening, slips, pressure, shears. Also node positions."""
    nodes, block, last = {}, None, {}
    reading = None
    for line in open(path):
        key = line[:5]
        if line.startswith("    2C"):
            reading = "nodes"
        elif key == " -4  ":
            reading = "contact" if "CONTACT" in line else None
            if reading:
                last = {}
        elif line[:3] == " -3":
            reading = None
        elif line[:3] == " -1" and reading:
            values = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range((len(line.rstrip()) - 13) // 12)]
            (nodes if reading == "nodes" else last)[int(line[3:13])] = values
    return nodes, last
