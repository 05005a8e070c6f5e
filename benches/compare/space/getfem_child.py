"""Solves a problem with GetFEM; run by the Python that has it: getfem_child.py JOB, a file of JSON written by with_getfem.py."""

import json
import sys

import getfem as gf
import numpy as np


class Child:
    def __init__(self, job):
        self.job, self.model = job, gf.Model("real")
        self.iterations, self.history = 0, []
        self.mesh, self.fem, self.integral = {}, {}, {}
        hexahedra = job["kind"] == "hex8"
        element = "FEM_QK(3,1)" if hexahedra else "FEM_PK(3,2)"
        rule = "IM_GAUSS_PARALLELEPIPED(3,4)" if hexahedra else "IM_TETRAHEDRON(5)"
        for name, file in job["files"].items():
            mesh = self.mesh[name] = gf.Mesh("import", "gmsh", file)
            self.fem[name] = gf.MeshFem(mesh, 3)
            self.fem[name].set_fem(gf.Fem(element))
            self.integral[name] = gf.MeshIm(mesh, gf.Integ(rule))
            self.model.add_fem_variable(f"u_{name}", self.fem[name])
            self.model.add_initialized_fem_data(f"Previous_u_{name}", self.fem[name], np.zeros(self.fem[name].nbdof()))
            self.material(name)
        self.given = {name: self.motions(name) for name in self.fem}
        self.contact(element)

    def region(self, side):
        return self.job["regions"][side]

    def material(self, name):
        md, young, poisson = self.model, self.job["young"][name], self.job["poisson"]
        md.add_initialized_data(f"lambda_{name}", [young * poisson / ((1 + poisson) * (1 - 2 * poisson))])
        md.add_initialized_data(f"mu_{name}", [young / (2 * (1 + poisson))])
        u, lame = f"u_{name}", (f"lambda_{name}", f"mu_{name}")
        if not self.job["plastic"]:
            md.add_isotropic_linearized_elasticity_brick(self.integral[name], u, *lame)
            return
        yields, modulus = self.job["plastic"]
        scalar = gf.MeshFem(self.mesh[name], 1)
        scalar.set_fem(gf.Fem("FEM_PK_DISCONTINUOUS(3,1)"))
        data = lambda size: gf.MeshImData(self.integral[name], -1, size)
        for key, value in (("Hk", 0.0), ("Hi", modulus), ("yields", yields)):
            md.add_initialized_data(f"{key}_{name}", [value])
        for key in (f"xi_{name}", f"Previous_xi_{name}"):
            md.add_initialized_fem_data(key, scalar, np.zeros(scalar.nbdof()))
        md.add_im_data(f"Ep_{name}", data([3, 3]))
        md.add_im_data(f"alpha_{name}", data(1))
        names = (u, f"xi_{name}", f"Ep_{name}", f"alpha_{name}", *lame, f"yields_{name}", f"Hk_{name}", f"Hi_{name}", "1", "timestep")
        self.law = getattr(self, "law", []) + [(self.integral[name], "Prandtl Reuss linear hardening", 0, *names)]
        md.add_small_strain_elastoplasticity_brick(*self.law[-1])

    def motions(self, body):
        """Constraints of a body, one for each component that is given: the brick and the number of the motion of each."""
        dofs = {}
        for number, (side, axis) in enumerate(self.job["motions"]):
            if side.split(".")[0] == body:
                on = np.array(self.fem[body].basic_dof_on_region(self.region(side)))
                dofs.update(dict.fromkeys(on[on % 3 == "xyz".index(axis)].tolist(), number))
        rows, columns = np.arange(len(dofs)), np.array(list(dofs))
        matrix = gf.Spmat("empty", len(dofs), self.fem[body].nbdof())
        matrix.assign(rows, columns, gf.Spmat("identity", len(dofs)))
        self.model.add_variable(f"held_{body}", len(dofs))
        brick = self.model.add_constraint_with_multipliers(f"u_{body}", f"held_{body}", matrix, np.zeros(len(dofs)))
        return brick, np.array(list(dofs.values()))

    def contact(self, element):
        job, md = self.job, self.model
        friction, slave, master = job["friction"], self.region(job["slave"]), self.region(job["master"])
        md.add_initialized_data("r", [job["augmentation"]])
        md.add_initialized_data("coefficient", [friction])
        md.add_initialized_data("alpha", [1.0])
        components = 3 if friction or job["brick"] == "raytracing" else 1
        self.multiplier = gf.MeshFem(self.mesh["upper"], components)
        self.multiplier.set_fem(gf.Fem(element.replace("3,2", f"3,{job['degree']}")))
        md.add_filtered_fem_variable("multiplier", self.multiplier, slave)
        if job["brick"] == "raytracing":
            brick = md.add_integral_large_sliding_contact_brick_raytracing("r", job["released"], "coefficient", "alpha", 0)
            add = md.add_slave_contact_boundary_to_large_sliding_contact_brick
            add(brick, self.integral["upper"], slave, "u_upper", "multiplier", "Previous_u_upper")
            add = md.add_master_contact_boundary_to_large_sliding_contact_brick
            add(brick, self.integral["lower"], master, "u_lower", "Previous_u_lower")
            return
        rest = ("coefficient", slave, master, 1, "alpha", "Previous_u_upper", "Previous_u_lower") if friction else (slave, master, 1)
        md.add_integral_contact_between_nonmatching_meshes_brick(self.integral["upper"], "u_upper", "u_lower", "multiplier", "r", *rest)

    def solve(self, wanted):
        """One step; false where it does not converge."""
        for brick, numbers in self.given.values():
            self.model.set_private_rhs(brick, np.array(wanted)[numbers])
        options = ("max_res", self.job["residual"], "max_iter", self.job["most"], "lsearch", "simplest", "alpha min", 0.6)
        done, converged = self.model.solve("noisy", *options, "lsolver", "mumps")
        self.iterations += done
        return bool(converged)

    def save(self):
        return [(n, self.model.variable(n)) for n in ("u_upper", "u_lower", "multiplier", "held_upper", "held_lower")]

    def step(self, before, after, time, length, deepest=6):
        """From one position to the next, in halves where Newton's method fails."""
        kept = self.save()
        if self.solve(after):
            for law in getattr(self, "law", ()):
                self.model.small_strain_elastoplasticity_next_iter(*law)
            for name in self.fem:
                self.model.set_variable(f"Previous_u_{name}", self.model.variable(f"u_{name}"))
            self.history.append((time + length, self.force()))
            return
        if not deepest:
            raise RuntimeError(f"no convergence at time {time + length:g} in steps of {length:g}")
        for name, value in kept:
            self.model.set_variable(name, value)
        middle = [(a + b) / 2 for a, b in zip(before, after)]
        self.step(before, middle, time, length / 2, deepest - 1)
        self.step(middle, after, time + length / 2, length / 2, deepest - 1)

    def force(self):
        mim, slave = self.integral["upper"], self.region(self.job["slave"])
        total = np.atleast_1d(gf.asm_generic(mim, 0, "multiplier", slave, self.model))
        return [float(v) for v in (total if len(total) == 3 else (0.0, total[0], 0.0))]

    def run(self):
        self.model.set_time_step(1.0)
        for time, before, after, length in self.job["steps"]:
            self.step(before, after, time, length)

    def result(self):
        found = {"iterations": self.iterations, "forces": self.history, "unknowns": int(self.model.nbdof()), "pressures": []}
        places, pressures = self.pressures()
        found["pressures"] = [[*map(float, place), float(p)] for place, p in zip(places, pressures)]
        return found

    def pressures(self):
        """Means of the multiplier around nodes of the slave, weighted by their functions: y components, as sides are nearly level."""
        slave, components = self.region(self.job["slave"]), self.multiplier.qdim()
        basic = np.array(self.multiplier.basic_dof_on_region(slave))
        values = np.array(self.model.variable("multiplier"))
        if len(values) != len(basic):
            return [], []
        mine = basic[1::3] if components == 3 else basic
        values = values[1::3] if components == 3 else values
        mass = gf.asm_mass_matrix(self.integral["upper"], self.multiplier, self.multiplier, slave)
        full, ones = np.zeros((2, self.multiplier.nbdof()))
        full[mine], ones[mine] = values, 1
        means = np.array(mass.mult(full))[mine] / np.array(mass.mult(ones))[mine]
        return self.multiplier.basic_dof_nodes(mine).T, means


def main():
    job = json.load(open(sys.argv[1]))
    child, why = Child(job), ""
    try:
        child.run()
    except Exception as error:
        why = f"{type(error).__name__}: {error}"
    json.dump({"why": why, **child.result()}, open("result.json", "w"))


if __name__ == "__main__":
    main()
