#!/usr/bin/env python3
"""Compares `section` with medium shells of stars whose fabric has other Poisson ratios than 0.39: the table of docs/ranges.md.

    python3 crates/research/poisson.py target/release/stargrip-cam [FOLDER]

Stars are drawn as those of the sets of stars.txt, with E and nu of their own. The ranges were widened so as to hold the first half; the second is
their test. Shells in FOLDER are not computed again. Twenty minutes.
"""
import json, math, pathlib, random, subprocess, sys, tempfile

HALF = 24
# Depth of the default flap, mm: `band` and `hole_allowance`.
FLAP = 3
GROUPS = ((0.0, 0.1), (0.2, 0.3), (0.45, 0.49))
NAMES = {"final_radius_mm": "final radius", "radial_stiffness_N_per_m": "radial stiffness", "force": "force",
         "wider": "force, object wider than the default hole"}
SPEC = 'schema = 1\nname = "star"\n[fabric]\nthickness = "{t} mm"\nyoung_modulus = "{E} MPa"\npoisson_ratio = {nu}\n[star]\npoints = {n}\n' \
       'inner_radius = "{rho_0} mm"\ntube_width = "{W} mm"\ntip_angle = "{phi} deg"\ntip_radius = "{R_i} mm"\ncorner_radius = "{R_e} mm"\n' \
       '[seal]\nband = "0.5 mm"\nhole_allowance = "0 mm"\n[load]\npressure = "{p} kPa"\n'


def stars():
    dice = random.Random(77)
    log = lambda low, high: math.exp(dice.uniform(math.log(low), math.log(high)))
    while True:
        n, W, t = dice.choice([3, 4, 5, 6, 7, 8]), round(log(15, 60), 1), round(log(0.1, 0.5), 3)
        phi, p = round(dice.uniform(15, 70), 1), round(log(5, 60), 1)
        nu, E = dice.choice([nu for group in GROUPS for nu in group]), dice.choice([40, 128, 300, 700])
        sharp = dice.random() < 0.3
        R_i, R_e = (0 if sharp else round(dice.uniform(0, 0.3) * W, 1) for _ in "ie")
        half = math.radians(phi / 2)
        reach = W * log(0.5, 5) * math.sin(half) + (W + R_i + R_e) * math.cos(half)
        rho_0 = round(reach / math.sin(math.pi / n) - W - R_e, 1)
        bending = E * 1e6 * (t * 1e-3) ** 3 / (12 * (1 - nu**2))
        is_usual = 0.0101 <= t / W <= 0.03 and 130 <= p * 1e3 * (W * 1e-3) ** 3 / bending <= 5000 \
            and p * W / (1e3 * E * t) < 0.1 and phi + 360 / n <= 160 and 0.6 <= rho_0 / W <= 6
        if is_usual:
            yield dict(n=n, W=W, t=t, phi=phi, p=p, nu=nu, E=E, R_i=R_i, R_e=R_e, rho_0=rho_0)


def answers(program, folder, number, star):
    """What `section` and the shell say of the star and of two objects that open it, by their JSON."""
    spec, kept = folder / f"{number}.toml", folder / f"{number}.json"
    spec.write_text(SPEC.format(**star))
    say = lambda *more: subprocess.run([program, "predict", str(spec), "--json", *more], capture_output=True, text=True).stdout
    rest = json.loads(say())["final_radius_mm"]
    opens = min(0.6 * star["W"], 0.95 * (star["rho_0"] - 0.5 - rest))
    radii = "--radii", f"{rest + 0.5 * opens:.3f} mm..{rest + opens:.3f} mm/2"
    if not kept.exists():
        kept.write_text(say(*radii, "--model", "shell", "--fineness", "medium"))
    return json.loads(say(*radii)), json.loads(kept.read_text())


def pairs(star, section, shell):
    """Quantity, the shell's number over the predicted one, and whether it lies in the range, with its mesh error and strictly; forces and
    stiffnesses that meshes leave a quarter open are left out."""
    errors = shell["evidence"]["mesh_errors"]
    rest = [(name, shell[name], errors[name], section[name], section["ranges"][name]) for name in list(NAMES)[:2]]
    forces = zip(section["force_curve"], shell["force_curve"], errors["force_curve"])
    opened = [("force" if ours[0] <= star["rho_0"] - FLAP else "wider", theirs[1], error, ours[1], ours[2:] if ours[2] is not None else None)
              for ours, theirs, error in forces]
    for name, value, error, predicted, ends in rest + opened:
        if ends and value and error < 0.25 * value:
            yield name, value / predicted, ends[0] <= value + error and value - error <= ends[1], ends[0] <= value <= ends[1]


def main():
    program = sys.argv[1]
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    found = []
    for number, star in zip(range(2 * HALF), stars()):
        found += [(number // HALF, star["nu"], *pair) for pair in pairs(star, *answers(program, folder, number + 1, star))]
    print("| stars | nu | quantity | numbers | shell by predicted, mean | least | most | in range | strictly |\n|---|---|---|---|---|---|---|---|---|")
    for half in (0, 1):
        for nus in GROUPS:
            for name, said in NAMES.items():
                own = [numbers for of, nu, what, *numbers in found if of == half and nu in nus and what == name]
                ratios, held, strictly = zip(*own)
                print(f"| {half * HALF + 1} to {(half + 1) * HALF} | {nus[0]}, {nus[1]} | {said} | {len(own)} | {sum(ratios) / len(ratios):.3f} "
                      f"| {min(ratios):.3f} | {max(ratios):.3f} | {sum(held)} | {sum(strictly)} |")


if __name__ == "__main__":
    main()
