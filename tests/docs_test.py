"""What README and docs/ say beside their commands: links, names of files, width of lines, generated pages: docs_test.py CLATHRA PROJECT"""
import os
import re
import subprocess
import sys
import unicodedata
import unittest
from pathlib import Path

CLATHRA, PROJECT = sys.argv[1], Path(sys.argv[2]).resolve()
sys.path.insert(0, str(PROJECT / "perf" / "validation"))

import claims  # noqa: E402

PAGES = [PROJECT / "README.md", *sorted((PROJECT / "docs").rglob("*.md"))]
REPORTS = sorted((PROJECT / "perf" / "reports").rglob("*.md"))
FENCE = re.compile(r"^```.*?^```", re.M | re.S)


def slug(heading):
    """The anchor of a heading, as MkDocs and GitHub make it."""
    plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    plain = unicodedata.normalize("NFKD", plain).encode("ascii", "ignore").decode()
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", plain).strip().lower())


def anchors(page):
    return {slug(line.lstrip("# ")) for line in FENCE.sub("", page.read_text()).splitlines() if line.startswith("#")}


class Docs(unittest.TestCase):
    def test_every_link_leads_to_a_file_and_a_heading(self):
        links = 0
        for page in PAGES + REPORTS:
            for target in re.findall(r"\]\(([^)\s]+)\)", FENCE.sub("", page.read_text())):
                if re.match(r"[a-z]+:", target):
                    continue
                links += 1
                name, _, anchor = target.partition("#")
                file = (page.parent / name).resolve() if name else page
                self.assertTrue(file.exists(), f"{page}: no file {target}")
                if anchor and file.suffix == ".md":
                    self.assertIn(anchor, anchors(file), f"{page}: no heading {target}")
                if page.is_relative_to(PROJECT / "docs"):
                    self.assertTrue(file.is_relative_to(PROJECT / "docs"), f"{page}: the site has no {target}")
        self.assertGreater(links, 100)

    def test_every_file_that_a_page_names_is_there(self):
        names = 0
        for page in PAGES:
            for name in re.findall(r"`((?:docs|drivers|examples|packaging|perf|scripts|share|src|tests)/[\w./-]*)", page.read_text()):
                names += 1
                self.assertTrue("NAME" in name or (PROJECT / name.rstrip(".")).exists(), f"{page}: no {name}")
        self.assertGreater(names, 100)

    def test_every_page_that_the_sources_name_is_there(self):
        listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=PROJECT, capture_output=True, text=True)
        files = [PROJECT / name for name in listed.stdout.splitlines()] or [Path(f) / n for f, _, ns in os.walk(PROJECT / "src") for n in ns]
        names = 0
        for file in files:
            if file.suffix in (".md", ".png", ".h5", ".gz") or not file.is_file():
                continue
            for name in re.findall(r"\b((?:docs|perf/reports)/[\w./-]+\.(?:md|svg|png))\b", file.read_text(errors="ignore")):
                names += 1
                self.assertTrue("NAME" in name or (PROJECT / name).exists(), f"{file}: no {name}")
        self.assertGreater(names, 20)

    def test_lines_fit_110_columns(self):
        for page in PAGES:
            for number, line in enumerate(page.read_text().splitlines(), 1):
                self.assertLessEqual(len(line), 110, f"{page}:{number}")

    def test_pages_hold_no_commit_and_reference_pages_no_machine_and_no_date(self):
        for page in PAGES:
            text = page.read_text()
            self.assertEqual([h for h in re.findall(r"\b[0-9a-f]{7,40}\b", text) if re.search("[a-f]", h) and re.search("[0-9]", h)], [], page)
            if page.parent.name == "reference":
                self.assertEqual(re.findall(r"\b(?:EPYC|Xeon|H100|H200|20\d\d-\d\d-\d\d)\b", text), [], page)

    def test_the_site_lists_every_page(self):
        listed = re.findall(r"[\w/-]+\.md", (PROJECT / "mkdocs.yml").read_text())
        self.assertEqual(sorted(listed), sorted(str(page.relative_to(PROJECT / "docs")) for page in PAGES[1:]))

    def test_the_command_line_is_that_of_the_program(self):
        made = subprocess.run([sys.executable, PROJECT / "scripts/command_line_page", CLATHRA], check=True, capture_output=True, text=True).stdout
        self.assertEqual((PROJECT / "docs/reference/command-line.md").read_text(), made,
                         "renew it: scripts/command_line_page CLATHRA > docs/reference/command-line.md")

    def test_the_claims_are_those_of_the_scorecard(self):
        card = (PROJECT / "perf/reports/0.1/scorecards/calibrated-standard.md").read_text()
        self.assertIn(claims.claims(card), (PROJECT / "docs/validation/paper.md").read_text(), "renew it: perf/validation/claims.py")

    def test_closed_forms_are_where_the_page_says(self):
        page = " ".join((PROJECT / "docs/validation/independent.md").read_text().split())
        items = [item for item in page.split(" - **")[1:] if "(`tests/" in item]
        self.assertGreater(len(items), 8)
        for item in items:
            sources = "".join((PROJECT / name).read_text() for name in re.findall(r"`(tests/\w+\.cpp)`", item))
            for suite in re.findall(r"`([A-Z]\w+)`", item):
                self.assertRegex(sources, rf"TEST(_F|_P)?\({suite}, ", item)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
