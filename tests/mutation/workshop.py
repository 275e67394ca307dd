"""A copy of the project that may be broken, and its own build: what a test program says of a source with a mutant in it."""

import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

import mutants

not_sources = {".git", "build", "out", "node_modules", "__pycache__"}

# Test programs with the tests of each that are run, soonest done first. Whole runs of cells come last. Benchmarks and tests of
# the program from outside (tests/system) are left out: minutes each, for whatever mutant.
fixtures = "ShearedCell.*:SenseOfRotation.*:Lockstep.*:Identify.*:BaselineDiff.*"
programs = {
    "stability": ("stability/stability_tests", "*"),
    "box2d": ("box2d/test_box2d", "*"),
    "cases": ("cases/cases_tests", "*"),
    "adapters": ("unit/unit_tests", "*"),
    "loader": ("cases_loader/cases_loader_tests", "*"),
    "grain": ("unit/grain_tests", "*"),
    "oracle": ("oracle/oracle_tests", "*"),
    "averaging": ("averaging/averaging_tests", "*"),
    "studies": ("studies/studies_tests", f"-{fixtures}"),
    "conformance": ("conformance/conformance_tests", "*/grain:*/box2d_penalty:*/box2d_impulse:*/PlantedFault.*"),
    "cells": ("studies/studies_tests", fixtures),
}
# The tests of the folder that a mutant is in, first.
own = {
    "engines/grain": ["grain"],
    "engines/box2d": ["box2d", "conformance"],
    "averaging": ["averaging"],
    "oracle": ["oracle"],
    "stability": ["stability"],
    "adapters": ["adapters", "cases"],
    "cases": ["cases", "loader"],
    "studies": ["studies"],
}
memory = 8 << 30  # [bytes] what a program may take


def order(folder, own_only):
    return own[folder] if own_only else [*own[folder], *(name for name in programs if name not in own[folder])]


class Workshop:
    def __init__(self, project, out):
        self.project, self.source = project, out / "source"
        self.build = self.source / "build/mutation"  # where builds are: a compiler cache knows what is compiled from there
        self.kept = out / "whole.json"  # what whole programs take, by their digests
        self.whole = json.loads(self.kept.read_text()) if self.kept.exists() else {}
        self.copy_sources()
        if not (self.build / "build.ninja").exists():
            self.configure()

    def copy_sources(self):
        """Only what differs: the build goes on where it was."""
        for here in self.sources():
            there = self.source / here.relative_to(self.project)
            if there.exists() and there.read_bytes() == here.read_bytes():
                continue
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here, there)

    def sources(self):
        """Without what is built, installed or written by runs."""
        for folder, inside, names in os.walk(self.project):
            inside[:] = sorted(name for name in inside if name not in not_sources)
            for name in names:
                if (pathlib.Path(folder) / name).is_file():
                    yield pathlib.Path(folder) / name

    def configure(self):
        include = self.project / "tests/mutation/one_by_one.cmake"
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON",
                        f"-DCMAKE_PROJECT_crossgrain_INCLUDE={include}"], check=True)

    def program(self, name):
        return self.build / "tests" / programs[name][0]

    def made(self, name):
        """@returns whether it compiles"""
        done = subprocess.run(["ninja", "-C", self.build, self.program(name).name], capture_output=True, text=True)
        if done.returncode != 0 and "error:" not in done.stdout:
            raise RuntimeError(done.stdout[-2000:] + done.stderr)
        return done.returncode == 0

    def run(self, name, cpu, wall):
        """@returns the test that failed first, a signal or "hang", or nothing; seconds of CPU"""
        with tempfile.TemporaryDirectory() as folder:  # packings that a mutant prepares are for no other
            environment = os.environ | {"CROSSGRAIN_CACHE": folder, "TMPDIR": folder, "RC_PARAMS": "seed=1"}

            def limits():
                resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 5))
                resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
                resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            words = [self.program(name), f"--gtest_filter={programs[name][1]}", "--gtest_fail_fast"]
            with subprocess.Popen(words, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  errors="replace", start_new_session=True, preexec_fn=limits) as process:
                try:
                    said = process.communicate(timeout=wall)[0]
                except subprocess.TimeoutExpired:
                    said = None
                finally:
                    end_group(process.pid)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if said is None or process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return "hang", seconds
        if process.returncode == 0:
            return "", seconds
        begun = re.findall(r"^\[ RUN      \] (\S+)", said, re.M)
        failed = re.search(r"^\[  FAILED  \] (\S+?)(?:,| \(|$)", said, re.M)
        return failed[1] if failed else f"{begun[-1] if begun else name}: signal {-process.returncode}", seconds

    def check_whole(self, names):
        """These programs pass as they are, and take so long; programs that are still the same are not run again."""
        for name in filter(names.__contains__, programs):
            if not self.made(name):
                raise SystemExit(f"{name} does not compile without any mutant")
            digest = hashlib.sha256(self.program(name).read_bytes()).hexdigest()
            if self.whole.get(name, {}).get("digest") == digest:
                continue
            failed, seconds = self.run(name, 3600, 7200)
            if failed:
                raise SystemExit(f"{failed} fails without any mutant")
            self.whole[name] = {"digest": digest, "seconds": round(seconds, 2)}
            self.kept.write_text(json.dumps(self.whole, indent=1))
            print(f"{name}: {seconds:.1f} s as it is", flush=True)

    def judge(self, mutant, own_only):
        """Plants it, builds and runs until a test fails. @returns result, which test, seconds"""
        began = time.monotonic()
        place = self.source / mutant.file
        source = place.read_text()
        place.write_text(mutant.applied(source))
        try:
            for name in order(mutants.folder_of(mutant.file), own_only):
                if not self.made(name):
                    return "does not compile", "", time.monotonic() - began
                usual = self.whole[name]["seconds"]
                failed = self.run(name, int(4 * usual + 20), 20 * usual + 300)[0]
                if failed:
                    return "killed", failed, time.monotonic() - began
            return "open" if own_only else "lived", "", time.monotonic() - began
        finally:
            place.write_text(source)


def end_group(group):
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass
