#!/usr/bin/env python3
"""Computes the paper's stars and one V-actuator as shells of every fineness, each as a process of its own: by_shell.txt.

    python3 crates/research/by_shell.py target/release/stargrip-cam crates/forecast/src/trade/by_shell.txt

Rows of the file are not computed again, if the file's commit is this one: else delete it first. Time is the user's, over all threads;
memory is the largest resident set. The program must be built from the commit that is checked out.
"""
import datetime, json, pathlib, subprocess, sys, tempfile

COMPUTED_BY = "# Computed by commit {commit} on {date}.\n"
HEAD = """\
# Shells of every fineness, by crates/research/by_shell.py; one computation a line.
# Stars: W 30 mm, rho_0 50 mm, phi_i0 30 deg, R 0; V-actuator: W 20 mm, R 2 mm, arms 80 mm, 60 deg; both t 0.3 mm, E 128 MPa, nu 0.39.
# fineness, n (0: the V-actuator), p kPa; radius mm or angle deg, its mesh error; K N/m or C N m, its mesh error; force N on the
# object of that radius mm, its mesh error (stars); unknowns of the finest mesh; user time s; memory MB.
"""
SPEC = 'schema = 1\nname = "star"\n[star]\npoints = {n}\ninner_radius = "50 mm"\ntube_width = "30 mm"\ntip_angle = "30 deg"\n' \
       '[load]\npressure = "{p} kPa"\n'
ACTUATOR = ["actuator", "--tube-width", "20 mm", "--radius", "2 mm", "--arm-length", "80 mm", "--angle", "60 deg"]


def objects():
    """0.45 W more than the radii of the set `paper`."""
    stars = pathlib.Path(__file__).parent / "src" / "stars" / "stars.txt"
    out = {}
    for line in stars.read_text().splitlines():
        words = line.split()
        if words[0] == "paper":
            number = lambda name: float(words[words.index(name) + 1])
            out[int(number("n")), int(number("p"))] = round(number("radius") + 0.45 * number("W"), 3)
    return out


def compute(program, fineness, n, p, radius):
    shell = ["--model", "shell", "--fineness", fineness, "--no-cache", "--json"]
    with tempfile.TemporaryDirectory() as folder:
        spec, cost = pathlib.Path(folder, "star.toml"), pathlib.Path(folder, "cost")
        spec.write_text(SPEC.format(n=n, p=p))
        if n:
            asked = ["predict", str(spec), "--radii", f"{radius} mm"]
        else:
            asked = ACTUATOR + ["--pressure", f"{p} kPa"]
        timed = ["/usr/bin/time", "-o", str(cost), "-f", "%U %M", program]
        said = json.loads(subprocess.run(timed + asked + shell, check=True, capture_output=True).stdout)
        time, memory = map(float, cost.read_text().split())
    evidence = said["evidence"]
    errors = evidence["mesh_errors"]
    if n:
        spring = said["radial_stiffness_N_per_m"]
        spring = "nan" if spring is None else f"{spring:.2f}"
        curve = said["force_curve"][0]
        force = curve[1] if isinstance(curve, list) else next(v for k, v in curve.items() if k.endswith("_N"))
        numbers = f"{said['final_radius_mm']:.3f} {errors['final_radius_mm']:.3f} " \
            f"{spring} {errors['radial_stiffness_N_per_m']:.2f} {force:.3f} {radius} {errors['force_curve'][0]:.3f}"
    else:
        numbers = f"{said['angle_deg']:.3f} {errors['angle_deg']:.3f} {said['stiffness_Nm']:.5f} {errors['stiffness_Nm']:.5f} - - -"
    return f"{numbers} {evidence['unknowns'][-1]} {time:.1f} {memory / 1e3:.0f}"


def main():
    program, path = sys.argv[1], pathlib.Path(sys.argv[2])
    commit = ["git", "-C", str(pathlib.Path(__file__).parent), "rev-parse", "--short=8", "HEAD"]
    commit = subprocess.run(commit, check=True, capture_output=True, text=True).stdout.strip()
    known = path.read_text() if path.exists() else HEAD + COMPUTED_BY.format(commit=commit, date=datetime.date.today())
    if f" commit {commit} on " not in known:
        sys.exit(f"{path} is of another commit than {commit}: delete it to compute all rows anew")
    path.write_text(known)
    at = objects()
    work = [("coarse", n, p) for p in (14, 37, 60) for n in range(3, 9)]
    work += [(fineness, 0, p) for fineness in ("coarse", "medium", "fine") for p in (14, 37, 60)]
    work += [("medium", n, p) for p in (37, 14, 60) for n in range(3, 9)]
    # For their times: their radii and stiffnesses are those of the set `paper`, by the same meshes.
    work += [("fine", n, 37) for n in (5, 3, 8)]
    for fineness, n, p in work:
        key = f"{fineness} {n} {p} "
        if not any(line.startswith(key) for line in known.splitlines()):
            with path.open("a") as file:
                file.write(key + compute(program, fineness, n, p, at.get((n, p))) + "\n")


main()
