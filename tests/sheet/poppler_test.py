#!/usr/bin/env python3
"""The setup sheets of the examples, as a PDF reader of another project has them: their pages, and the texts of the page in HTML.

usage: poppler_test.py BIN_FOLDER. Skipped (77) where Poppler's tools are not installed. With ISOCNC_SCREENSHOTS=FOLDER it
leaves a picture of a sheet there, which docs/images/ has.
"""

import html.parser
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path()
EXAMPLES = ["pocket.iso", "drilling.iso", "option.iso", "five-faces.iso", "setups/panel.iso", "machine/shelf.iso",
            "setups/broken/panel.iso", "broken/pocket.iso"]


class Texts(html.parser.HTMLParser):
    """The texts of a page, but for its style and drawings."""

    def __init__(self):
        super().__init__()
        self.texts = []
        self.hidden = 0

    def handle_starttag(self, tag, attrs):
        self.hidden += tag in ("style", "title", "svg")

    def handle_endtag(self, tag):
        self.hidden -= tag in ("style", "title", "svg")

    def handle_data(self, data):
        if not self.hidden and data.strip():
            self.texts.append(data)


def plain(text):
    """Without blanks: a PDF breaks lines elsewhere."""
    return re.sub(r"\s+", "", text)


class Sheets(unittest.TestCase):
    def test_say_the_same_in_both_formats(self):
        for example in EXAMPLES:
            for language in ("en", "it"):
                with self.subTest(f"{example}, {language}"), tempfile.TemporaryDirectory() as folder:
                    page, pdf = Path(folder) / "sheet.html", Path(folder) / "sheet.pdf"
                    for target in (page, pdf):
                        run = subprocess.run([BIN / "isorun", "--lang", language, "--sheet", target, ROOT / "examples" / example],
                                             capture_output=True, check=False)
                        self.assertIn(run.returncode, (0, 1), run.stderr)
                    info = subprocess.run(["pdfinfo", pdf], capture_output=True, text=True, check=True)
                    self.assertEqual(info.stderr, "")
                    self.assertRegex(info.stdout, r"Pages: +1\n")
                    self.assertIn("(A4)", info.stdout)
                    read = subprocess.run(["pdftotext", "-raw", pdf, "-"], capture_output=True, text=True, check=True)
                    self.assertEqual(read.stderr, "")
                    parser = Texts()
                    parser.feed(page.read_text(encoding="utf-8"))
                    self.assertGreater(len(parser.texts), 20)
                    words = plain(read.stdout)
                    for text in parser.texts:
                        # Cells of several lines stand beside others: each of their words is there.
                        for word in text.split():
                            self.assertIn(word, words)

    def test_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            pdf = Path(folder) / "sheet.pdf"
            subprocess.run([BIN / "isorun", "--sheet", pdf, ROOT / "examples/setups/panel.iso"], capture_output=True, check=True)
            picture = Path(folder) / "sheet"
            drawn = subprocess.run(["pdftoppm", "-r", "90", "-png", "-singlefile", pdf, picture], capture_output=True, check=True)
            self.assertEqual(drawn.stderr, b"")
            self.assertGreater(picture.with_suffix(".png").stat().st_size, 10_000)
            if "ISOCNC_SCREENSHOTS" in os.environ:
                shutil.copy(picture.with_suffix(".png"), Path(os.environ["ISOCNC_SCREENSHOTS"]) / "sheet.png")


if __name__ == "__main__":
    BIN = Path(sys.argv.pop(1)).resolve()
    if not shutil.which("pdftotext"):
        print("poppler: skipped: there is no pdftotext")
        sys.exit(77)
    unittest.main()
