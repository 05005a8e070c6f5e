"""Scenes varied by key path, written as TOML again."""

import json
import tomllib


def parsed(path):
    """Keys and indices of a path such as `stages[0].conditions[1].x`."""
    for part in path.split("."):
        key, *entries = part.split("[")
        yield key
        yield from (int(entry.rstrip("]")) for entry in entries)


class Scene:
    def __init__(self, text):
        self.tables = tomllib.loads(text)

    def _owner(self, path):
        *owners, last = parsed(path)
        table = self.tables
        for key in owners:
            table = table[key]
        table[last]  # KeyError or IndexError where nothing is there.
        return table, last

    def put(self, path, value):
        """Replaces the value at a path, which must be there."""
        table, key = self._owner(path)
        table[key] = value

    def remove(self, path):
        """Removes the key or entry at a path, which must be there."""
        table, key = self._owner(path)
        del table[key]

    def text(self):
        return "".join(f"{json.dumps(key)} = {inline(value)}\n" for key, value in self.tables.items())


def inline(value):
    """A value as TOML on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)} = {inline(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    return json.dumps(value)
