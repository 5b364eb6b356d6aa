#!/usr/bin/env python3
"""Opens stars of stars.txt as coarse shells: those whose arms touch, and those of the set `test` that an object can open by 1.5 W: opened.txt.

    python3 crates/research/opened.py target/release/stargrip-cam crates/research/src/stars/opened.txt

Stars in the file are not computed again. Touching stars that no object opens by 0.5 W are left out.
"""
import json, pathlib, subprocess, sys, tempfile

HEAD = """\
# Stars of stars.txt opened by objects as coarse shells, by crates/research/opened.py; one object a line.
# Set, number, the object's radius mm, force N, its mesh error N, final radius mm.
"""
SPEC = 'schema = 1\nname = "star"\n[fabric]\nthickness = "{t} mm"\n[star]\npoints = {n:.0f}\ninner_radius = "{rho_0} mm"\n' \
       'tube_width = "{W} mm"\ntip_angle = "{phi_i0} deg"\ntip_radius = "{R_i} mm"\ncorner_radius = "{R_e} mm"\n' \
       '[load]\npressure = "{p} kPa"\n'


def stars():
    """Set and number of each star with its sizes, and its objects' least and largest radius, mm."""
    for line in (pathlib.Path(__file__).parent / "src" / "stars" / "stars.txt").read_text().splitlines():
        words = line.split()
        if words[0] == "#" or "radius" not in words:
            continue
        number = lambda name: float(words[words.index(name) + 1])
        sizes = {name: number(name) for name in ("n", "W", "rho_0", "phi_i0", "R_i", "R_e", "t", "p")}
        radius, width = number("radius"), sizes["W"]
        # The cut hole is smaller than rho_0.
        room = (sizes["rho_0"] - radius) / width - 0.06
        touches = number("arm_contact") > 0
        if room >= 0.5 if touches else room >= 1.52 and words[0] == "test":
            yield words[:2], sizes, [radius + part * width for part in (0.45, min(room, 1.6))]


def compute(program, sizes, objects):
    with tempfile.TemporaryDirectory() as folder:
        spec = pathlib.Path(folder, "star.toml")
        spec.write_text(SPEC.format(**sizes))
        radii = "{:.3f} mm..{:.3f} mm/3".format(*objects)
        shell = [program, "predict", str(spec), "--model", "shell", "--fineness", "coarse", "--no-cache", "--json", "--radii", radii]
        done = subprocess.run(shell, capture_output=True, text=True)
    if done.returncode:
        return
    said = json.loads(done.stdout)
    for (radius, force, *_), error in zip(said["force_curve"], said["evidence"]["mesh_errors"]["force_curve"]):
        yield f"{radius:.3f} {force:.4f} {error:.4f} {said['final_radius_mm']:.3f}"


def main():
    program, path = sys.argv[1], pathlib.Path(sys.argv[2])
    known = path.read_text().splitlines() if path.exists() else []
    lines = HEAD.splitlines()
    for name, sizes, objects in stars():
        own = [line for line in known if line.split()[:2] == name]
        lines += own or [" ".join([*name, line]) for line in compute(program, sizes, objects)]
        path.write_text("\n".join(lines + [line for line in known if line not in lines]) + "\n")
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
