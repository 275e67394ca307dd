"""Each kernel object file shares nothing with the others but its tables, and contracts nothing.

A function that several objects define weakly (an inline function that was not inlined) exists once
in the program, and the linker may take the copy compiled for AVX-512 for all. A fused multiply-add
rounds once where two instructions round twice: sets with and without it would give other bits.

Usage: kernel_objects.py NM OBJDUMP OBJECT...
"""

import pathlib
import re
import subprocess
import sys

TABLE = re.compile(r"grain::Kernels<(float|double)> grain::(\w+)<\1>\(\)")

FUSED = re.compile(r"\bvfn?m(?:add|sub)\w*")


def shared_symbols(nm, path):
    """(weak or unique definitions that are no table, the tables) of an object file."""
    lines = subprocess.run([nm, "-C", "--defined-only", path], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    others, tables = [], []
    for line in lines:
        _, kind, name = line.split(maxsplit=2)
        table = TABLE.fullmatch(name)
        if table:
            tables.append(table.groups())
        elif kind in "WwVvuTDBR":  # visible to other objects
            others.append(f"{kind} {name}")
    return others, tables


def contractions(objdump, path):
    """Fused multiply-adds of an object file, vfmaddsub and the like among them."""
    with subprocess.Popen([objdump, "-d", "--no-show-raw-insn", path], stdout=subprocess.PIPE,
                          text=True) as listing:
        return sorted({found for line in listing.stdout for found in FUSED.findall(line)})


def main():
    nm, objdump, *objects = sys.argv[1:]
    if len(objects) < 3:
        sys.exit("wanted: the objects of three instruction sets")
    failed = False
    names = set()
    for path in objects:
        others, tables = shared_symbols(nm, path)
        names |= {name for _, name in tables}
        if {real for real, _ in tables} != {"float", "double"}:
            failed = True
            print(f"{path}: no tables for float and double, but {tables}")
        fused = contractions(objdump, path)
        if fused:
            failed = True
            print(f"{path}: {', '.join(fused)}")
        for symbol in others:
            failed = True
            print(f"{pathlib.Path(path).parent.name}: {symbol}")
    if len(names) != len(objects):
        failed = True
        print(f"{len(objects)} objects, but tables named {sorted(names)}")
    sys.exit(failed)


main()
