#!/usr/bin/env python3
"""Compares the formula of the pull on the seal with medium shells of stars with round hinges: docs/models.md.

    python3 crates/research/pull.py target/release/stargrip-cam crates/research/pulls.txt [FROM..TO]

Stars are drawn by seed, with E, nu and a band of their own. Stars 1 to 132 gave the exponent of narrow bands, 1 to 108 their range; those
from 133 on gave nothing. A line of the file is a star's number, its shell's pull and mesh error, N/mm, whether it is at a tip, the
formula's when it was computed, and unknowns of the finest mesh; stars that it lists are not computed again. FROM..TO computes those stars first.
At the end the pull that the program predicts now is compared with the shells. A quarter of an hour of one processor.
"""
import json, math, pathlib, random, subprocess, sys, tempfile

SETS = ((1, 48), (49, 84), (85, 108), (109, 132), (133, 150))
BINS = ((0, 0.5), (0.5, 0.8), (0.8, 1.2), (1.2, 99))
WIDE, NARROW = ((0.8, (0.75, 1.35)), (0.5, (0.64, 1.55)))
SPEC = 'schema = 1\nname = "star"\n[fabric]\nthickness = "{t} mm"\nyoung_modulus = "{E} MPa"\npoisson_ratio = {nu}\n[star]\npoints = {n}\n' \
       'inner_radius = "{rho_0} mm"\ntube_width = "{W} mm"\ntip_angle = "{phi} deg"\ntip_radius = "{R_i} mm"\ncorner_radius = "{R_e} mm"\n' \
       '[seal]\nband = "{band} mm"\n[load]\npressure = "{p} kPa"\n'


def bendability(star):
    bending = star["E"] * 1e6 * (star["t"] * 1e-3) ** 3 / (12 * (1 - star["nu"] ** 2))
    return star["p"] * 1e3 * (star["W"] * 1e-3) ** 3 / bending


def stars():
    dice = random.Random(1948)
    log = lambda low, high: math.exp(dice.uniform(math.log(low), math.log(high)))
    while True:
        n, W, t = dice.choice([3, 4, 5, 6, 7, 8]), round(log(15, 60), 1), round(log(0.1, 0.5), 3)
        phi, p, band = round(dice.uniform(15, 70), 1), round(log(5, 60), 1), round(dice.uniform(1, 4), 1)
        nu, E = round(dice.uniform(0, 0.49), 2), round(log(40, 700))
        R_i, R_e = (round(log(0.03, 0.3) * W, 1) for _ in "ie")
        half = math.radians(phi / 2)
        reach = W * log(0.5, 5) * math.sin(half) + (W + R_i + R_e) * math.cos(half)
        rho_0 = round(reach / math.sin(math.pi / n) - W - R_e, 1)
        star = dict(n=n, W=W, t=t, phi=phi, p=p, nu=nu, E=E, R_i=R_i, R_e=R_e, rho_0=rho_0, band=band)
        # The band makes hinges of half its width at least.
        if 0.0101 <= t / W <= 0.03 and 130 <= bendability(star) <= 5000 and p * W / (1e3 * E * t) < 0.1 \
                and phi + 360 / n <= 160 and 0.6 <= rho_0 / W <= 6 and min(R_i, R_e) >= band / 2:
            yield star


def computed(program, number, star):
    with tempfile.TemporaryDirectory() as folder:
        spec = pathlib.Path(folder, "star.toml")
        spec.write_text(SPEC.format(**star))
        say = lambda *more: json.loads(subprocess.run([program, "predict", str(spec), "--json", *more], capture_output=True, text=True).stdout)
        ours, shell = say("--model", "ring"), say("--model", "shell", "--fineness", "medium", "--no-cache")
    if "refused" in shell:
        return f"{number} - - - - -"
    # Corners lie at rho_0, tips beyond the arms.
    is_tip = math.hypot(*shell["seal_pull_at_mm"]) > star["rho_0"] + star["W"] / 2
    evidence = shell["evidence"]
    return f"{number} {shell['seal_pull_N_per_mm']:.5f} {evidence['mesh_errors']['seal_pull_N_per_mm']:.5f} {is_tip:d} " \
        f"{ours['seal_pull_N_per_mm']:.5f} {evidence['unknowns'][-1]}"


def tried_range(ratio):
    """The program's range of the pull over the predicted one for a band of `ratio` times the hinge's radius."""
    share = min(max(math.log(WIDE[0] / ratio) / math.log(WIDE[0] / NARROW[0]), 0), 1)
    return [wide * (narrow / wide) ** share for wide, narrow in zip(WIDE[1], NARROW[1])]


def predicted(program, star):
    """The largest pull that the program predicts, N/mm, without a shell."""
    with tempfile.TemporaryDirectory() as folder:
        spec = pathlib.Path(folder, "star.toml")
        spec.write_text(SPEC.format(**star))
        run = subprocess.run([program, "predict", str(spec), "--json", "--model", "ring"], check=True, capture_output=True, text=True)
    return json.loads(run.stdout)["seal_pull_N_per_mm"]


def compare(program, path):
    """Prints the shell's pull by the predicted one: its geometric mean over each set and each bin of w/R, and how many lie in the range."""
    ratios = []
    lines = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    computed_stars = dict(zip(range(1, SETS[-1][1] + 1), stars()))
    for words in lines:
        star = computed_stars.get(int(words[0]))
        if star and words[1] != "-":
            narrow = star["band"] / star["R_i" if words[3] == "1" else "R_e"]
            ratios.append((int(words[0]), narrow, float(words[1]) / predicted(program, star)))
    groups = [(f"{first} to {last}", [row for row in ratios if first <= row[0] <= last]) for first, last in SETS]
    groups += [(f"w/R {low} to {high}", [row for row in ratios if low <= row[1] < high]) for low, high in BINS]
    for name, group in [(name, group) for name, group in groups if group]:
        parts = [part for _, _, part in group]
        mean = math.exp(sum(map(math.log, parts)) / len(parts))
        ranges = [tried_range(narrow) for _, narrow, _ in group]
        inside = sum(low <= part <= high for part, (low, high) in zip(parts, ranges))
        print(f"{name:15} {len(parts):4} stars, mean {mean:.2f}, {min(parts):.2f} to {max(parts):.2f}, {inside} in the range")


def main():
    program, path = sys.argv[1], pathlib.Path(sys.argv[2])
    first, last = map(int, sys.argv[3].split("..")) if len(sys.argv) > 3 else (1, SETS[-1][1])
    lines = path.read_text().splitlines() if path.exists() else []
    known = {int(line.split()[0]) for line in lines if not line.startswith("#")}
    for number, star in zip(range(1, last + 1), stars()):
        if number >= first and number not in known:
            with path.open("a") as file:
                file.write(computed(program, number, star) + "\n")
    compare(program, path)


if __name__ == "__main__":
    main()
