#!/usr/bin/env python3
"""Makes the site of the documentation and follows its links: every page is there, and none leads nowhere."""

import html.parser
import pathlib
import shutil
import subprocess
import sys
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "build/site/html"
PLAYGROUND = ROOT / "build/web/playground/index.html"


class Page(html.parser.HTMLParser):
    """What a page leads to and shows, and the places in it that others can lead to."""

    def __init__(self, path):
        super().__init__()
        self.targets = []
        self.ids = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            if (tag, name) in (("a", "href"), ("img", "src"), ("script", "src"), ("link", "href")):
                self.targets.append(value)


class SiteTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([ROOT / "scripts/site"], check=True, stdout=subprocess.DEVNULL)
        cls.pages = {path: Page(path) for path in SITE.rglob("*.html") if path.name not in ("404.html", "search.html")}

    def test_has_a_page_of_every_document(self):
        documents = [path.relative_to(ROOT).with_suffix("") for path in (ROOT / "docs").rglob("*.md")]
        self.assertGreater(len(documents), 15)
        for document in documents:
            page = document.with_name("index") if document.name == "README" else document
            self.assertIn(SITE / f"{page}.html", self.pages)

    def test_leads_to_what_is_there(self):
        followed = 0
        for path, page in self.pages.items():
            for target in page.targets:
                url = urllib.parse.urlsplit(target)
                if url.scheme or url.netloc:
                    continue
                other = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
                with self.subTest(page=str(path.relative_to(SITE)), target=target):
                    self.assertTrue(other.is_file())
                    if url.fragment and other in self.pages:
                        self.assertIn(urllib.parse.unquote(url.fragment), self.pages[other].ids)
                followed += 1
        self.assertGreater(followed, 100)

    def test_has_the_playground_where_it_is_built(self):
        leading = [page for page in self.pages.values() if any("playground/index.html" in target for target in page.targets)]
        self.assertEqual((SITE / "playground/index.html").exists(), PLAYGROUND.exists())
        self.assertEqual(len(leading) > 20, PLAYGROUND.exists())
        self.assertTrue(leading or not PLAYGROUND.exists())

    def test_fetches_nothing_from_elsewhere(self):
        for path in self.pages:
            text = path.read_text(encoding="utf-8")
            self.assertNotRegex(text, r'<(script|img)[^>]* src="(https?:)?//')
            self.assertNotRegex(text, r'<link[^>]* rel="stylesheet"[^>]* href="(https?:)?//')


if __name__ == "__main__":
    if not shutil.which("mkdocs"):
        print("skipped: there is no mkdocs here")
        sys.exit(77)
    unittest.main()
