"""Kept reports of the thesis' claims follow from their results to the bit, and say why a claim is refuted."""

import json
import pathlib
import shutil
import tomllib

from harness import CASES, HELD, SystemTest

CURATED = pathlib.Path(__file__).resolve().parents[2] / "reports/curated"
FOLDERS = sorted(file.parent for file in CURATED.glob("thesis*/results.json"))
REASONS = CASES / "couette/thesis/reasons.toml"


def shipped():
    return tomllib.loads(REASONS.read_text(encoding="utf-8"))["reasons"]


def turned(condition):
    """What holds where the condition does not."""
    same = {key: condition[key] for key in ("claim", "figure") if key in condition}
    if "above" in condition:
        return same | {"below": condition["above"]}
    return same | {"above": condition["below"]}


def toml_of(reasons):
    def inline(condition):
        members = (f"{key} = {json.dumps(value)}" for key, value in condition.items())
        return "{ " + ", ".join(members) + " }"

    parts = []
    for reason in reasons:
        lines = [f"{key} = {json.dumps(value)}" for key, value in reason.items() if key != "when"]
        conditions = ", ".join(inline(each) for each in reason["when"])
        parts.append("\n".join(["[[reasons]]", *lines, f"when = [{conditions}]"]))
    return "\n\n".join(parts) + "\n"


class CuratedThesis(SystemTest):
    def judged_again(self, folder, *arguments):
        """The claims of a report that is made from the folder's results alone."""
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir()
        shutil.copy(folder / "results.json", self.out)
        self.assert_status(self.run_program("report", self.out, *arguments), HELD)
        return self.results()["claims"]

    def test_tables_follow_from_results_to_the_bit(self):
        self.assertTrue(FOLDERS)
        for folder in FOLDERS:
            self.judged_again(folder)
            for kept in [*folder.glob("*.csv"), folder / "results.json"]:
                self.assertEqual(kept.read_bytes(), (self.out / kept.name).read_bytes(), kept)

    def test_every_refuted_claim_has_a_reason_that_somebody_found_and_none_is_idle(self):
        printed = set()
        for folder in FOLDERS:
            seen = set()
            for claim in self.judged_again(folder, "--reasons", REASONS):
                found = [reason for reason in claim["reasons"] if " (Rests on " in reason]
                printed.update(reason.split(" (Rests on ")[0] for reason in found)
                standard = (claim["id"], claim["engine"]) not in seen  # the reading taken comes first
                seen.add((claim["id"], claim["engine"]))
                if standard and claim["verdict"] == "refuted" and claim["engine"] in ("grain", "-"):
                    self.assertTrue(found, f"{folder.name}: {claim['id']}, {claim['engine']}")
        self.assertEqual({reason["text"] for reason in shipped()}, printed)

    def test_a_reason_goes_with_each_of_its_conditions(self):
        held = shipped()
        reversed_ones = [
            reason
            | {"text": f"turned: {reason['text']}"}
            | {"when": [*reason["when"][:k], turned(condition), *reason["when"][k + 1 :]]}
            for reason in held
            for k, condition in enumerate(reason["when"])
        ]
        file = self.folder / "turned.toml"
        file.write_text(toml_of([*held, *reversed_ones]), encoding="utf-8")
        compared = 0
        for folder in FOLDERS:
            for claim in self.judged_again(folder, "--reasons", file):
                texts = [reason.split(" (Rests on ")[0] for reason in claim["reasons"]]
                for text in {reason["text"] for reason in held} & set(texts):
                    self.assertNotIn(f"turned: {text}", texts, f"{folder.name}: {claim['id']}")
                    compared += 1
        self.assertGreaterEqual(compared, len(held))
