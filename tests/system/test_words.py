"""Help, documents and pages use the words of the field: none of the private ones that they replaced.

Names in `code` are contracts (keys of case files, columns, members of results.json) and are left out.
"""

import html
import os
import pathlib
import re
import subprocess
import unittest

from harness import SystemTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "tests/reports/crossgrain_sample_reports"

# word → what is said in its place
REPLACED = {
    r"told|tells?|telling|untold": "reported, reports; printed; expressed as",
    r"looks? by look|further looks?|(?:each|every|last|first|two|four|\d+) looks?|looks? at \d+": "interim analysis; snapshot",
    r"held against|hold against|holds against": "compared with",
    r"fell short|falls? short|falling short": "failed, fails",
    r"packings? lost": "failed runs",
    r"carried|carriers?": "surrogate: evaluated through its mirror",
    r"canary|canaries": "spot check",
    r"what parts them": "difference",
    r"first that is open": "undecided",
    r"what is off": "deviation found",
    r"same law": "equivalent",
    r"legs?|ladders?|climbs?|climbing|sittings?": "run, parameter sweep, campaign, session",
    r"strangers?": "external engine",
    r"yardsticks?": "reference perturbation",
    r"hurried|distrust\w*|babbl\w*": "quick; discard; oversized message",
    r"in words": "described",
}
# Where such a word is the field's own, or a contract.
ALLOWED = [
    r"cannot tell",  # a verdict of steadiness.csv
    r"climb from a lower",
    r"ladder\.toml",  # a file name that runs are known by
    r"have the same law|the same law and",
]


def found(text):
    """(word, better, context) of each private word of a text."""
    for allowed in ALLOWED:
        text = re.sub(allowed, " ", text)
    for word, better in REPLACED.items():
        for match in re.finditer(rf"\b(?:{word})\b", text, re.IGNORECASE):
            yield match[0], better, " ".join(text[max(0, match.start() - 50) : match.end() + 30].split())


def of_markdown(text):
    return re.sub(r"```.*?```|`[^`]*`|\]\([^)]*\)", " ", text, flags=re.DOTALL)


def of_page(text):
    text = re.sub(r"<(script|style|code|pre|svg)\b.*?</\1>", " ", text, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", " ", text))


class Words(SystemTest):
    def check(self, texts):
        """@param texts  by name"""
        self.assertGreater(len(texts), 3)
        wrong = [
            f"{name}: '{word}' ({better}): …{context}…" for name, text in texts.items() for word, better, context in found(text)
        ]
        self.assertEqual([], wrong[:40], f"{len(wrong)} in all")

    def test_finds_them(self):
        self.assertEqual(["told", "fell short"], [word for word, *_ in found("As we told you, it fell short; we cannot tell.")])
        self.assertEqual([], list(found(of_markdown("see `looks.count` and [x](carried.md)"))))
        self.assertEqual(["carried"], [word for word, *_ in found(of_page("<b title='legs'>carried</b><code>legs</code>"))])

    def test_documents(self):
        listed = [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("*/**/README.md")]
        build = pathlib.Path(os.environ["CROSSGRAIN_BUILD"])
        # Curated pages are what the program of their day printed.
        kept = [file for file in listed if "curated" not in file.parts and build.parent not in file.parents and "node_modules" not in file.parts]
        self.check({str(file.relative_to(ROOT)): of_markdown(file.read_text(encoding="utf-8")) for file in kept})

    def test_help(self):
        texts = {"": self.run_program("--help").stdout}
        commands = re.findall(r"^  ([a-z]+) ", texts[""], re.MULTILINE)
        texts |= {command: self.run_program(command, "--help").stdout for command in commands}
        self.check(texts)

    def test_pages(self):
        subprocess.run([SAMPLES, self.folder / "samples"], check=True, capture_output=True)
        pages = {
            str(file.relative_to(self.folder)): (of_page if file.suffix == ".html" else of_markdown)(file.read_text(encoding="utf-8"))
            for file in (self.folder / "samples").rglob("*")
            if file.suffix in (".html", ".md")
        }
        self.check(pages)


if __name__ == "__main__":
    unittest.main()
