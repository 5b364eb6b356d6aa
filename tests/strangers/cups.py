"""CUPS' pdftopdf, the filter between an application and a printer, leaves pages of the printer's own paper at 100 %.

Usage: cups.py FILTER PAGES-a4.pdf...; the printer takes A4 with margins of 6.35 mm.
"""
import os
import subprocess
import sys
import tempfile

from PIL import Image

DPI = 200
SHARE = 1e-3  # of the ink's extent: a pixel in 200 mm is 6e-4

PPD = """*PPD-Adobe: "4.3"
*FormatVersion: "4.3"
*FileVersion: "1.0"
*LanguageVersion: English
*LanguageEncoding: ISOLatin1
*PCFileName: "A4.PPD"
*Manufacturer: "None"
*Product: "(None)"
*ModelName: "A4"
*ShortNickName: "A4"
*NickName: "A4"
*PSVersion: "(3010.000) 0"
*LanguageLevel: "3"
*ColorDevice: False
*DefaultColorSpace: Gray
*OpenUI *PageSize/Media Size: PickOne
*DefaultPageSize: A4
*PageSize A4/A4: "<</PageSize[595 842]>>setpagedevice"
*CloseUI: *PageSize
*OpenUI *PageRegion/Media Size: PickOne
*DefaultPageRegion: A4
*PageRegion A4/A4: "<</PageSize[595 842]>>setpagedevice"
*CloseUI: *PageRegion
*DefaultImageableArea: A4
*ImageableArea A4/A4: "18 18 577 824"
*DefaultPaperDimension: A4
*PaperDimension A4/A4: "595 842"
"""


def ink(pdf, work):
    """Extent of the drawing on each page, mm."""
    for old in os.listdir(work):
        if old.startswith("page"):
            os.remove(os.path.join(work, old))
    subprocess.run(["pdftoppm", "-r", str(DPI), "-gray", pdf, os.path.join(work, "page")], check=True)
    found = []
    for name in sorted(name for name in os.listdir(work) if name.startswith("page")):
        left, top, right, bottom = Image.open(os.path.join(work, name)).point(lambda v: 255 if v < 200 else 0).getbbox()
        found.append(((right - left) * 25.4 / DPI, (bottom - top) * 25.4 / DPI))
    return found


def main():
    problems = []
    with tempfile.TemporaryDirectory() as work:
        ppd, printed = os.path.join(work, "a4.ppd"), os.path.join(work, "printed.pdf")
        with open(ppd, "w", encoding="ascii") as file:
            file.write(PPD)
        for pdf in sys.argv[2:]:
            for options in ("", "print-scaling=none", "print-scaling=auto"):
                command = [sys.argv[1], "1", "user", "title", "1", options, pdf]
                with open(printed, "wb") as file:
                    subprocess.run(command, stdout=file, stderr=subprocess.DEVNULL, env={**os.environ, "PPD": ppd}, check=True)
                before, after = ink(pdf, work), ink(printed, work)
                scales = [b / a for x, y in zip(before, after) for a, b in zip(x, y)]
                print(f"{pdf}: {options or 'default'}: {len(after)} pages, scale {min(scales):.5f} to {max(scales):.5f}")
                if len(before) != len(after) or any(abs(scale - 1.0) > SHARE for scale in scales):
                    problems.append(f"{pdf}: CUPS with {options or 'no option'} prints {after} mm for {before}")
    if problems:
        sys.exit("\n".join(problems))


main()
