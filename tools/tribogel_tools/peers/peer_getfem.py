"""Two cylinders in GetFEM: its large-sliding contact brick by ray tracing, on our own mesh. A program of its
own, because GetFEM's time counts as a child's: it reads a scene and two meshes (numpy's npz) and prints one
line of JSON.

  /usr/bin/python3 peer_getfem.py MESHES.npz ELEMENT STEPS

Q1/P0: one pressure a cell beside the displacements; Q2: displacements alone. Multipliers like the
displacements on the slave face. A load step that does not converge is halved, up to five times."""
import json
import math
import sys

import numpy

ELEMENTS = {"Q1/P0": 1, "Q2": 2}
SLAVE, MASTER, PLATE = 1, 2, 3
AUGMENTATION = 10  # times the shear modulus
RELEASE = 1.0  # distance beyond which no contact is looked for [mm]
TOLERANCE, ITERATIONS, HALVINGS = 1e-7, 25, 5


class Peer:
    def __init__(self, gf, meshes, scene, element):
        self.gf, self.scene, self.order = gf, scene, ELEMENTS[element]
        self.model = md = gf.Model("real")
        md.add_initialized_data("G", scene["G"])
        md.add_initialized_data("K", scene["K"])
        # GetFEM does not keep alive what a model refers to.
        self.meshes, self.laws, self.plates, self.pressures = [], [], [], []
        self.fems = [self.body(k, meshes, element) for k in (0, 1)]
        self.multiplier = self.fem(self.meshes[1])
        md.add_filtered_fem_variable("contact", self.multiplier, SLAVE)
        for name, value in (("r", AUGMENTATION * scene["G"]), ("mu", scene["mu"]), ("alpha", 1)):
            md.add_initialized_data(name, value)
        for k in (0, 1):
            md.add_fem_data(f"w{k}", self.fems[k])
        brick = md.add_integral_large_sliding_contact_brick_raytracing("r", RELEASE, "mu", "alpha", 0)
        self.rules = ims = [self.integration(mesh, 5) for mesh in self.meshes]
        add_slave = md.add_slave_contact_boundary_to_large_sliding_contact_brick
        add_slave(brick, ims[1], SLAVE, "u1", "contact", "w1")
        md.add_master_contact_boundary_to_large_sliding_contact_brick(brick, ims[0], MASTER, "u0", "w0")
        self.iterations = 0

    def fem(self, mesh, dim=3):
        fem = self.gf.MeshFem(mesh, dim)
        fem.set_fem(self.gf.Fem(f"FEM_QK(3,{self.order})"))
        return fem

    def integration(self, mesh, degree):
        return self.gf.MeshIm(mesh, self.gf.Integ(f"IM_GAUSS_PARALLELEPIPED(3,{degree})"))

    def body(self, k, meshes, element):
        gf, md = self.gf, self.model
        nodes, cells = meshes[f"nodes{k}"], meshes[f"cells{k}"]
        mesh = gf.Mesh("empty", 3)
        mesh.add_convex(gf.GeoTrans(f"GT_QK(3,{self.order})"), nodes[cells].transpose(2, 1, 0))
        self.meshes.append(mesh)
        plate = self.scene["top_height"] if k else -self.scene["bottom_height"]
        for region, height in ((PLATE, plate), (SLAVE if k else MASTER, 0)):
            points = numpy.flatnonzero(numpy.abs(mesh.pts()[2] - height) < 1e-9)
            mesh.set_region(region, mesh.faces_from_pid(points))
        fem = self.fem(mesh)
        md.add_fem_variable(f"u{k}", fem)
        im = self.integration(mesh, 3 if self.order == 1 else 5)
        law = f"G/2*(pow(Det(Id(3)+Grad_u{k}),-2/3)*Norm_sqr(Id(3)+Grad_u{k})-3)"
        if element == "Q1/P0":
            pressure = gf.MeshFem(mesh, 1)
            self.pressures.append(pressure)
            pressure.set_classical_discontinuous_fem(0)
            md.add_fem_variable(f"p{k}", pressure)
            law += f"+p{k}*(Det(Id(3)+Grad_u{k})-1)-sqr(p{k})/(2*K)"
        else:
            law += f"+K/2*sqr(Det(Id(3)+Grad_u{k})-1)"
        md.add_nonlinear_term(im, law)
        self.laws.append((im, law))
        md.add_fem_data(f"plate{k}", fem)
        md.add_Dirichlet_condition_with_simplification(f"u{k}", PLATE, f"plate{k}")
        self.plates.append(numpy.unique(fem.basic_dof_on_region(PLATE)))
        return fem

    def move_plate(self, approach, angle):
        c, s = math.cos(angle), math.sin(angle)
        places = self.fems[1].basic_dof_nodes()[:, ::3]
        u = numpy.array([(c - 1) * places[0] - s * places[1], s * places[0] + (c - 1) * places[1],
                         numpy.full(places.shape[1], -approach)])
        self.model.set_variable("plate1", u.T.ravel())

    def advance(self, approach, angle, before, halvings=0):
        """One load step from the state `before` = (approach, angle); halves it where Newton's method
        fails."""
        md = self.model
        old = [md.variable(f"u{k}").copy() for k in (0, 1)]
        state = md.from_variables().copy()
        for k in (0, 1):
            md.set_variable(f"w{k}", old[k])
        self.move_plate(approach, angle)
        try:
            count, converged = md.solve("max_res", TOLERANCE, "max_iter", ITERATIONS, "lsolver", "mumps")[:2]
        except RuntimeError:
            count, converged = ITERATIONS, False
        self.iterations += int(count)
        if converged:
            return
        if halvings == HALVINGS:
            raise ArithmeticError(f"Newton fails at approach {approach:.4g} mm, angle {angle:.4g}")
        md.to_variables(state)
        middle = ((approach + before[0]) / 2, (angle + before[1]) / 2)
        self.advance(*middle, before, halvings + 1)
        self.advance(approach, angle, middle, halvings + 1)

    def forces(self):
        im, law = self.laws[1]
        whole = self.gf.asm("generic", im, 1, law, -1, self.model)
        first, size = self.model.interval_of_variable("u1")
        f = numpy.asarray(whole).ravel()[first:first + size].reshape(-1, 3)[self.plates[1][::3] // 3]
        u = self.model.variable("u1").reshape(-1, 3)[self.plates[1][::3] // 3]
        x = self.fems[1].basic_dof_nodes()[:, ::3].T[self.plates[1][::3] // 3] + u
        return float(-f[:, 2].sum()), float((x[:, 0] * f[:, 1] - x[:, 1] * f[:, 0]).sum())

    def unknowns(self):
        return int(self.model.nbdof() - sum(len(dofs) for dofs in self.plates))


def main():
    import getfem as gf
    gf.util_trace_level(0)
    gf.util_warning_level(0)
    path, element, steps = sys.argv[1], sys.argv[2], int(sys.argv[3])
    with numpy.load(path) as meshes:
        scene = json.loads(str(meshes["scene"]))
        peer = Peer(gf, meshes, scene, element)
    report = {"unknowns": peer.unknowns(), "failure": None, "N": math.nan, "T": math.nan}
    try:
        before = (0.0, 0.0)
        for approach, angle in [*((scene["approach"] * (k + 1) / steps, 0.0) for k in range(steps)),
                                *((scene["approach"], scene["turn"] * (k + 1) / steps)
                                  for k in range(steps))]:
            peer.advance(approach, angle, before)
            before = (approach, angle)
        report["N"], report["T"] = peer.forces()
    except ArithmeticError as error:
        report["failure"] = str(error)
    print(json.dumps(report | {"iterations": peer.iterations}))


if __name__ == "__main__":
    main()
