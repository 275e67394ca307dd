"""Makes the pictures of docs/gallery.md by the commands that stand under them: `cmake --build … --target pictures`.

    pictures.py PROGRAM FOLDER [NAME…]

A command's last words are `--out out/NAME    # FILE of that folder`; the picture is FILE, or the first screen of a
report.html as Chromium draws it. What FOLDER holds already is not run again. Prints the report's conclusion,
beside which the page's finding is read."""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys

PAGE = pathlib.Path(__file__).with_name("gallery.md")
ENTRY = re.compile(r"!\[[^]]*\]\(((?:pictures/)?\S+?)\)\s+```\n(crossgrain .*?) --out out/(\S+) +# (\S+)\n```")


def first_screen(page, picture):
    subprocess.run(
        ["chromium", "--headless", "--no-sandbox", "--hide-scrollbars", "--window-size=1280,760",
         f"--screenshot={picture}", f"file://{page}"], check=True, capture_output=True, timeout=120,
    )  # fmt: skip


def main(program, folder, *names):
    for picture, command, name, source in ENTRY.findall(PAGE.read_text(encoding="utf-8")):
        if names and name not in names:
            continue
        out = pathlib.Path(folder).resolve() / name
        print(f"{name}: {command}", flush=True)
        done = subprocess.run(
            [program, *shlex.split(command)[1:], "--out", str(out)], cwd=PAGE.parents[1], check=False,
            capture_output=True, text=True,
        )  # fmt: skip
        if done.returncode > 1:  # 1 is a verdict
            sys.exit(f"status {done.returncode}\n{done.stderr}")
        print((out / "summary.md").read_text(encoding="utf-8"), flush=True)
        drawn = PAGE.parent / picture
        drawn.parent.mkdir(exist_ok=True)
        if source.endswith(".html"):
            first_screen(out / source, drawn)
        else:
            shutil.copy(out / source, drawn)


if __name__ == "__main__":
    main(*sys.argv[1:])
