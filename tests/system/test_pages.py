"""Reports as a browser shows them: at three widths, light and dark, without their script, and what it adds.

One start of Debian's chromium for all: every report is put into frames of these widths on one page, and a
script of that page looks into them. Skipped where there is no chromium, which packages.txt has not."""

import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

WIDTHS = (390, 700, 1000, 1280, 1920)
HEIGHT = 800
LEAST_LETTERS = 11  # [px]
LEAST_CONTRAST = 4.5  # WCAG 2, AA

CHROMIUM = shutil.which("chromium")
SAMPLES = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "tests/reports/crossgrain_sample_reports"

# Looks into each frame; what it finds is JSON in the page's text.
LOOK = r"""
const least = %d, leastContrast = %g;
function colourOf(text) {
  const n = (text.match(/[\d.]+/g) || []).map(Number);
  if (text.startsWith('color(srgb')) return [n[0] * 255, n[1] * 255, n[2] * 255, n.length > 3 ? n[3] : 1];
  return [n[0], n[1], n[2], n.length > 3 ? n[3] : 1];
}
function luminance(c) {
  const part = v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  return 0.2126 * part(c[0]) + 0.7152 * part(c[1]) + 0.0722 * part(c[2]);
}
function behind(view, element) {
  for (; element; element = element.parentElement) {
    const c = colourOf(view.getComputedStyle(element).backgroundColor);
    if (c[3] > 0.99) return c;
  }
  return [255, 255, 255, 1];
}
function contrast(a, b) {
  const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p);
  return (x + 0.05) / (y + 0.05);
}
function look(frame) {
  const doc = frame.contentDocument, view = frame.contentWindow, root = doc.documentElement;
  const found = {name: frame.dataset.name, width: +frame.dataset.width,
                 overflow: root.scrollWidth - root.clientWidth,
                 paper: view.getComputedStyle(doc.body).backgroundColor, small: [], faint: [], cut: [], told: 0, short: [], matrixCut: 0, plots: []};
  for (const details of doc.querySelectorAll('details')) details.open = false;
  const matrix = doc.querySelector('table.overview');
  const pictures = [...doc.querySelectorAll('img, svg.bar')].filter(image => image.checkVisibility({contentVisibilityAuto: true}) && image.getClientRects().length);
  found.pictureAt = pictures.length ? pictures[0].getBoundingClientRect().top + view.scrollY : null;
  found.matrixEnds = matrix ? matrix.getBoundingClientRect().bottom + view.scrollY : null;
  for (const details of doc.querySelectorAll('details')) details.open = true;
  for (const box of doc.querySelectorAll('label.more input')) box.checked = true;
  found.overflow = Math.max(found.overflow, root.scrollWidth - root.clientWidth);
  const walker = doc.createTreeWalker(doc.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode, parent = node.parentElement;
    if (!node.data.trim() || !parent.getClientRects().length) continue;
    const style = view.getComputedStyle(parent);
    if (style.visibility === 'hidden') continue;
    const told = node.data.trim().slice(0, 40);
    if (parseFloat(style.fontSize) < least) found.small.push([told, style.fontSize]);
    if (contrast(colourOf(style.color), behind(view, parent)) < leastContrast) found.faint.push(told);
  }
  for (const table of doc.querySelectorAll('table')) {
    const box = table.closest('.scroll');
    if (!box || box.getBoundingClientRect().right > root.clientWidth + 1) found.cut.push(table.className || 'table');
  }
  found.forestCut = Math.max(0, ...[...doc.querySelectorAll('table.forest')].map(t => t.parentElement.scrollWidth - t.parentElement.clientWidth));
  const legend = doc.querySelector('#legend');
  found.legendCut = legend ? legend.scrollWidth - legend.clientWidth : 0;
  if (matrix) found.matrixCut = matrix.parentElement.scrollWidth - matrix.parentElement.clientWidth;
  for (const words of doc.querySelectorAll('.overview small')) {
    ++found.told;  // what hangs below a line is no line
    if (words.scrollHeight > words.clientHeight + 8 || words.scrollWidth > words.clientWidth + 2)
      found.short.push(words.textContent);
  }
  for (const image of doc.querySelectorAll('img')) {
    const svg = new TextDecoder().decode(Uint8Array.from(atob(image.src.split(',')[1]), c => c.charCodeAt(0)));
    const letters = [...svg.matchAll(/(?:<g [^>]*font-size=["']|font-size:)([\d.]+)/g)].map(m => +m[1]).filter(s => s > 0);
    if (letters.length && image.naturalWidth)
      found.plots.push([image.alt.slice(0, 40), Math.min(...letters) * image.getBoundingClientRect().width / image.naturalWidth]);
  }
  return found;
}
addEventListener('load', () => {
  const all = [...document.querySelectorAll('iframe')].map(look);
  const result = document.createElement('pre');
  result.id = 'found';
  result.textContent = JSON.stringify(all);
  document.body.replaceChildren(result);
});
""" % (LEAST_LETTERS, LEAST_CONTRAST)


# Does what a reader does with a report's own script; what comes of it is JSON in the page's text.
USE = r"""
const later = () => new Promise(done => setTimeout(done, 300));
// A table of a reader's own making beside those of the page: what sorts it is the page's script.
async function useTables(frame, longer) {
  const doc = frame.contentDocument, view = frame.contentWindow, found = {}, copied = [];
  Object.defineProperty(view.navigator, 'clipboard', {value: {writeText: async text => { copied.push(text); }}});
  const head = doc.querySelector('th.n.sorts'), table = head.closest('table'), body = table.tBodies[0];
  const column = head.cellIndex, tools = table.closest('.scroll').nextElementSibling;
  const made = ['3.2 ± 0.4', '–', '−3×10⁻⁴', '12', 'no limit', '2e-3'];
  while (body.rows.length < made.length) body.append(body.rows[0].cloneNode(true));
  while (body.rows.length > made.length) body.rows[0].remove();
  made.forEach((text, k) => { body.rows[k].cells[column].textContent = text; });
  const order = () => [...body.rows].map(row => row.cells[column].textContent);
  head.click();
  found.up = order();
  head.dispatchEvent(new view.KeyboardEvent('keydown', {key: 'Enter', bubbles: true}));
  found.down = order();
  found.sorted = head.getAttribute('aria-sort');
  tools.querySelector('button').click();
  const block = doc.querySelector('pre');
  block.nextElementSibling.querySelector('button').click();
  await later();
  found.csv = copied[0].trim().split('\n').slice(1).map(line => line.includes('12'));
  found.lines = copied[0].trim().split('\n').length;
  found.block = copied[1] === block.textContent;
  const filter = longer.contentDocument.querySelector('.tools input[type=search]');
  const many = filter.closest('.tools').previousElementSibling.querySelector('tbody');
  filter.value = 'no such words';
  filter.dispatchEvent(new view.Event('input'));
  found.hidden = [...many.rows].every(row => row.hidden);
  filter.value = '';
  filter.dispatchEvent(new view.Event('input'));
  found.shown = [...many.rows].every(row => !row.hidden);
  return found;
}
addEventListener('load', async () => {
  const [tables, longer] = document.querySelectorAll('iframe');
  const found = await useTables(tables, longer).catch(error => String(error));
  const result = document.createElement('pre');
  result.id = 'found';
  result.textContent = JSON.stringify(found);
  document.body.replaceChildren(result);
});
"""


def harness(reports):
    """A page of frames: each report at each width. Their own scripts, had they any, do not run."""
    frames = "".join(
        f'<iframe sandbox="allow-same-origin" data-name="{name}" data-width="{width}" width="{width}" '
        f'height="{HEIGHT}" style="border:0" srcdoc="{html.escape(page)}"></iframe>'
        for name, page in reports.items()
        for width in WIDTHS
    )
    return f"<!doctype html><meta charset=utf-8><script>{LOOK}</script><body>{frames}"


def found_by(harness_page, dark=False):
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "harness.html"
        page.write_text(harness_page, encoding="utf-8")
        command = [
            CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder}/profile",
            f"--blink-settings=preferredColorScheme={0 if dark else 1}", "--virtual-time-budget=20000",
            "--dump-dom", page.as_uri(),
        ]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True)
    found = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.S)
    return json.loads(html.unescape(found.group(1)))


def looked_at(reports, dark):
    return found_by(harness(reports), dark)


@unittest.skipUnless(CHROMIUM and SAMPLES.exists(), "needs chromium and the sample reports")
class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        subprocess.run([SAMPLES, cls.folder.name], check=True, capture_output=True)
        cls.reports = {
            path.parent.name: path.read_text(encoding="utf-8")
            for path in sorted(pathlib.Path(cls.folder.name).glob("*/report.html"))
        }
        cls.reports["site"] = (pathlib.Path(cls.folder.name) / "site/index.html").read_text(encoding="utf-8")
        cls.light = looked_at(cls.reports, dark=False)

    def each(self, found, check):
        for one in found:
            with self.subTest(report=one["name"], width=one["width"]):
                check(one)

    def test_all_were_looked_at(self):
        self.assertEqual(
            sorted((one["name"], one["width"]) for one in self.light),
            sorted((name, width) for name in self.reports for width in WIDTHS),
        )
        for command in ("compare", "collide", "effects", "stability", "cost", "lockstep", "average", "rev"):
            self.assertIn(command, self.reports)

    def test_nothing_is_cut_at_the_side(self):
        def check(one):
            self.assertLessEqual(one["overflow"], 0)
            self.assertEqual(one["cut"], [], "tables scroll within a box of their own")
            self.assertLessEqual(one["forestCut"], 0, "the verdict is the last column")
            self.assertLessEqual(one["legendCut"], 0)

        self.each(self.light, check)

    def test_letters_are_large_enough(self):
        def check(one):
            self.assertEqual(one["small"], [])
            for plot, letters in one["plots"]:
                self.assertGreaterEqual(letters, LEAST_LETTERS - 0.1, plot)

        self.assertGreater(sum(len(one["plots"]) for one in self.light), 50, "plots have letters")
        self.each(self.light, check)

    def test_the_matrix_needs_no_scrolling(self):
        def check(one):
            self.assertIsNotNone(one["matrixEnds"])
            self.assertLessEqual(one["matrixCut"], 0, "nor at the side")
            if one["width"] == 1280:
                self.assertLess(one["matrixEnds"], HEIGHT)

        self.each([one for one in self.light if one["name"] != "site"], check)  # an index is a list

    def test_the_first_picture_is_not_far(self):
        def check(one):
            if one["pictureAt"] is not None:
                self.assertLess(one["pictureAt"], 2000)

        self.assertGreater(sum(one["pictureAt"] is not None for one in self.light), 30)
        self.each(self.light, check)

    def test_small_words_of_the_matrix_are_told_in_full(self):
        self.each(self.light, lambda one: self.assertEqual(one["short"], []))
        many = [one["told"] for one in self.light if one["name"] == "collide-many"]
        self.assertEqual(len(many), len(WIDTHS))
        self.assertGreater(min(many), 36, "of nine engines, too")

    def test_words_stand_out_light_and_dark(self):
        few = {name: self.reports[name] for name in ("compare", "cost", "stability", "site")}
        dark = looked_at(few, dark=True)
        self.assertNotEqual(dark[0]["paper"], self.light[0]["paper"], "the browser was asked for dark")
        self.each(self.light + dark, lambda one: self.assertEqual(one["faint"], []))

    def used(self):
        frames = "".join(
            f'<iframe width="1280" height="100000" srcdoc="{html.escape(self.reports[name])}"></iframe>'
            for name in ("collide", "collide-many")
        )
        return found_by(f"<!doctype html><meta charset=utf-8><script>{USE}</script><body>{frames}")

    def test_tables_sort_filter_and_copy(self):
        tables = self.used()
        self.assertIsInstance(tables, dict, tables)
        self.assertEqual(tables["up"], ["−3×10⁻⁴", "2e-3", "3.2 ± 0.4", "12", "no limit", "–"])
        self.assertEqual(tables["down"], ["12", "3.2 ± 0.4", "2e-3", "−3×10⁻⁴", "no limit", "–"])
        self.assertEqual(tables["sorted"], "descending")
        self.assertEqual(tables["lines"], 7)
        self.assertTrue(tables["csv"][0], "rows in the order that is shown")
        self.assertTrue(tables["block"])
        self.assertTrue(tables["hidden"] and tables["shown"])

    def test_pages_need_no_other_file(self):
        for name, page in self.reports.items():
            for outside in ("<script src", "<link", "http:", "https:", "import("):
                self.assertNotIn(outside, page, name)


if __name__ == "__main__":
    unittest.main()
