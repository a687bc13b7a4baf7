"""Writes the decks of verification/deformable and verification/contact. Run it from the root of the project; the decks it wrote are committed."""
import pathlib

import beam_cases
import contact_cases
import formulation_cases
import shell_cases
import solid_cases
import solid_plates
from deck import card

HEAD = """*KEYWORD
*TITLE
{title}
$ {about}
$ Units: kg, m, s, N. Comma-separated fields; every number is given in full double precision.
$ Written by verification/tools/make_deformable.py.
$
*CONTROL_TERMINATION
{end},0
$ DTINIT, TSSFAC: the step that the verification gives is the largest
*CONTROL_TIMESTEP
0,1.0
$ Q1, Q2
*CONTROL_BULK_VISCOSITY
{q1},{q2}
*DATABASE_GLSTAT
{output},0
*DATABASE_BINARY_D3PLOT
{output},0
$
*SECTION_SOLID
1,1
*MAT_ELASTIC
1,{density},{modulus},0
*PART
bar
1,1,1
"""


def bar(path, title, about, length, elements, density, modulus, q, end, loads):
    """A square bar along x, one element across, its end at x = 0 held in x and all its nodes free in x only.

    `loads` are the lines behind the mesh; node set 1 is the held end, node set 2 the free end."""
    h = length / elements
    text = HEAD.format(title=title, about=about, end=end, output=end / 20, density=density, modulus=modulus, q1=q[0], q2=q[1])
    nodes, solids = [], []
    for i in range(elements + 1):
        for k, (y, z) in enumerate(((0, 0), (h, 0), (h, h), (0, h))):
            nodes.append(card(4 * i + k + 1, i * h, y, z, 7 if i == 0 else 5))  # TC 7: x, y, z; 5: y, z
    for i in range(elements):
        a = 4 * i + 1
        solids.append(card(i + 1, 1, a, a + 4, a + 5, a + 1, a + 3, a + 7, a + 6, a + 2))
    last = 4 * elements + 1
    text += "$ the held end and the free end\n*SET_NODE_LIST\n1\n1,2,3,4\n*SET_NODE_LIST\n2\n" + card(*range(last, last + 4)) + "\n"
    text += loads(h) + "*NODE\n" + "\n".join(nodes) + "\n*ELEMENT_SOLID\n" + "\n".join(solids) + "\n*END\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def step_load(pressure):
    def lines(h):
        force = pressure * h * h / 4
        return ("$ force on each of the four end nodes, from t = 0 on\n*DEFINE_CURVE\n1\n" + card(0, force) + "\n" + card(1, force) +
                "\n*LOAD_NODE_SET\n2,1,1,1.0\n")
    return lines


def impact(speed):
    def lines(_):
        return ("$ everything moves towards the wall, which is the held end\n*INITIAL_VELOCITY_GENERATION\n" + card(1, 2, 0, -speed, 0, 0) +
                "\n" + card(0, 0, 0, 0, 0, 0) + "\n")
    return lines


def main():
    root = pathlib.Path("verification/deformable")
    for n in (100, 200):
        bar(root / "bar_step" / f"bar_{n}.k", "Elastic bar under a step load", f"A bar of {n} hexahedra, 1 MPa on its free end from t = 0 on.",
            1.0, n, 7850.0, 210e9, (1.5, 0.06), 1.6e-3, step_load(1e6))
    bar(root / "bar_wall" / "bar_200.k", "Elastic bar against a wall", "A bar of 200 hexahedra hits a wall at 10 m/s; its nodes at x = 0 stay there.",
        0.0324, 200, 8930.0, 117e9, (1.5, 0.06), 2.6e-5, impact(10.0))
    shell_cases.write_all()
    solid_cases.write_all()
    beam_cases.write_all()
    formulation_cases.write_all()
    solid_plates.write_all()
    contact_cases.write_all()


if __name__ == "__main__":
    main()
