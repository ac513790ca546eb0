#!/usr/bin/env python3
"""What docs/editors.md gives users of Notepad++: the language has all that Notepad++ reads of one, and colors our examples; the filter of
NppExec finds file, line and column in what isolint prints.

usage: notepad_test.py BIN_DIR
"""

import pathlib
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
ISOLINT = pathlib.Path(sys.argv[1]).resolve() / "isolint"
LANGUAGE = xml.etree.ElementTree.parse(ROOT / "cmake/windows/notepad++/isocnc.xml").getroot()
NUMBERED = range(1, 9)

# The names that Notepad++ looks for in the format 2.1, in its own spelling. It passes over others without a word.
LISTS = {"Comments", *(f"Numbers, {kind}{i}" for kind in ("prefix", "extras", "suffix") for i in (1, 2)), "Numbers, range",
         "Operators1", "Operators2", *(f"Folders in {where}, {part}" for where in ("code1", "code2", "comment") for part in ("open", "middle", "close")),
         *(f"Keywords{i}" for i in NUMBERED), "Delimiters"}
STYLES = {"DEFAULT", "COMMENTS", "LINE COMMENTS", "NUMBERS", "OPERATORS", "FOLDER IN CODE1", "FOLDER IN CODE2", "FOLDER IN COMMENT",
          *(f"{kind}{i}" for kind in ("KEYWORDS", "DELIMITERS") for i in NUMBERED)}


def words(name):
    return (LANGUAGE.find(f"UserLang/KeywordLists/Keywords[@name='{name}']").text or "").split()


class Language(unittest.TestCase):
    def test_it_has_all_that_notepad_reads(self):
        self.assertEqual(LANGUAGE.tag, "NotepadPlus")
        language = LANGUAGE.find("UserLang")
        self.assertEqual((language.get("name"), language.get("udlVersion")), ("ISOCNC", "2.1"))
        self.assertEqual(language.get("ext"), "iso nc cnc tap ngc")
        self.assertEqual({each.get("name") for each in LANGUAGE.iterfind("UserLang/KeywordLists/Keywords")}, LISTS)
        self.assertEqual({each.get("name") for each in LANGUAGE.iterfind("UserLang/Styles/WordsStyle")}, STYLES)
        self.assertEqual(set(language.find("Settings/Global").keys()),
                         {"caseIgnored", "allowFoldOfComments", "foldCompact", "forcePureLC", "decimalSeparator"})
        self.assertEqual(set(language.find("Settings/Prefix").keys()), {f"Keywords{i}" for i in NUMBERED})
        for style in LANGUAGE.iterfind("UserLang/Styles/WordsStyle"):
            self.assertRegex(style.get("fgColor"), "^[0-9A-F]{6}$")
            self.assertRegex(style.get("bgColor"), "^[0-9A-F]{6}$")
            self.assertEqual(set(style.keys()), {"name", "fgColor", "bgColor", "fontName", "fontStyle", "nesting"})

    def test_comments_and_delimiters_are_numbered(self):
        # Each part of a comment or delimiter starts with its number of two digits, and none is missing.
        for name, count in (("Comments", 5), ("Delimiters", 24)):
            self.assertEqual(sorted({int(word[:2]) for word in words(name)}), list(range(count)))

    def style_of(self, word):
        """The style of a word, as Notepad++ chooses it."""
        prefixes = LANGUAGE.find("UserLang/Settings/Prefix")
        for i in NUMBERED:
            is_prefix = prefixes.get(f"Keywords{i}") == "yes"
            if any(word.upper().startswith(each) if is_prefix else word.upper() == each for each in words(f"Keywords{i}")):
                return f"KEYWORDS{i}"
        return "NUMBERS" if any(word.startswith(letter) for letter in words("Numbers, prefix1")) else "DEFAULT"

    def test_examples_are_colored(self):
        self.assertEqual([self.style_of(word) for word in ("G1", "g02", "G90", "M06", "T101001", "IF", "F1200", "VGPL", "V3", "N10", "X-1.5", "j2")],
                         ["KEYWORDS1", "KEYWORDS1", "KEYWORDS2", "KEYWORDS3", "KEYWORDS4", "KEYWORDS5", "KEYWORDS6", "KEYWORDS7", "KEYWORDS7",
                          "KEYWORDS8", "NUMBERS", "NUMBERS"])
        count = 0
        for program in (ROOT / "examples").glob("*.iso"):
            for word in re.split(r"[\s=<>]+", re.sub(r";.*|\([^)]*\)?", "", program.read_text(encoding="utf-8"), flags=re.MULTILINE)):
                if word and not re.match(r"[-+.\d]", word):
                    count += 1
                    self.assertNotEqual(self.style_of(word), "DEFAULT", f"{program.name}: {word}")
        self.assertGreater(count, 100)


class Compiler(unittest.TestCase):
    def test_the_filter_finds_the_place(self):
        for page in ("editors.md",):
            text = (ROOT / "docs" / page).read_text(encoding="utf-8")
            script = re.search(r"^NPP_SAVE\n(.*)$", text, re.MULTILINE).group(1)
            arguments = script.replace('"$(FULL_CURRENT_PATH)"', str(ROOT / "examples/broken/five-axis.iso")).split()
            self.assertEqual(arguments[0], "isolint")
            mask = re.search(r"^%ABSFILE%.*$", text, re.MULTILINE).group(0)
            pattern = re.escape(mask).replace(r"\*", ".*")
            for name, expression in (("ABSFILE", r"(?:[A-Za-z]:)?[^:*?]+"), ("LINE", r"\d+"), ("CHAR", r"\d+")):
                pattern = pattern.replace(f"%{name}%", f"(?P<{name}>{expression})")
            for language in ("en", "it"):
                printed = subprocess.run([ISOLINT, "--lang", language, *arguments[1:]], capture_output=True, text=True, check=False).stdout.splitlines()
                self.assertGreater(len(printed), 1)
                for line in printed:
                    match = re.fullmatch(pattern, line)
                    self.assertTrue(match, line)
                    self.assertTrue(pathlib.Path(match["ABSFILE"]).is_file())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
