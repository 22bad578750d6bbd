#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the pages say is true: check_docs.py WHAT SOURCE [PROGRAM | COMPILER FLAGS...]

commands  runs every `sateen` command of README.md, docs/ and the examples at the end of each --help, page by page, in a folder
          where examples/ lies and the names the pages use for a user's own pictures stand for shipped ones
snippets  compiles the C++ of the pages, each on its own
links     every link between the pages, and to a heading, leads somewhere
"""
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# A user's own files in the pages, and what stands for them.
STAND_INS = {"examples/textures/weave_normal.png": ["normal.png", "u.png", "v.png", "angle.png", "orm.png", "anisotropy.png",
                                                    "level.png", "turns.png", "rough.png"]}


# What a user of `sateen shade` has rendered before.
PREPARE = ["render examples/garment/jacket.obj --material examples/materials/satin.json --size 64 --aov normal,tangent -o jacket.png"]


def pages(source):
    return [source / "README.md"] + sorted((source / "docs").glob("*.md"))


def blocks(text, *languages):
    return [m[2] for m in re.finditer(r"^```(\w*)\n(.*?)^```", text, re.S | re.M) if m[1] in languages]


def commands_of(text):
    """Lines of fenced blocks that call the program, without prompts and comments; lines ending in \\ are joined."""
    found = []
    for block in blocks(text, "", "sh"):
        for line in block.replace("\\\n", " ").splitlines():
            line = re.sub(r"^\$ ", "", line.strip())
            words = shlex.split(line, comments=True) if line.startswith(("sateen ", "build/release/bin/sateen ")) else []
            if words:
                found.append(words[1:])
    return found


def verbs(program, path=()):
    """Every command line that takes options: ("amc", "build") and so on, with its help."""
    text = subprocess.run([program, *path, "--help"], capture_output=True, text=True, check=True).stdout
    listed = re.search(r"^Subcommands:\n(.*)", text, re.S | re.M)
    if listed is None:
        return [(path, text)]
    names = re.findall(r"^  ([a-z][\w-]*)\s", listed[1], re.M)
    return [entry for name in names for entry in verbs(program, (*path, name))]


def check_commands(source, program):
    faults = 0
    groups = [(page.name, commands_of(page.read_text())) for page in pages(source)]
    for path, text in verbs(program):
        examples = re.findall(r"^  sateen (.*)", text.split("Example:")[-1], re.M) if "Example:" in text else []
        if not examples:
            print(f"sateen {' '.join(path)} --help has no example")
            faults += 1
        groups.append((f"sateen {' '.join(path)} --help", [shlex.split(line) for line in examples]))
    # Commands build on what those before them wrote: all run in one folder, the pages first.
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "examples").symlink_to(source / "examples")
        for file, names in STAND_INS.items():
            for stand_in in names:
                shutil.copy(source / file, folder / stand_in)
        (folder / "photos").symlink_to(source / "examples/capture")
        (folder / "edits.json").write_text('[{"edit": "intensity", "part": "high", "factor": 0.5}]')
        variables = {"$SLURM_ARRAY_TASK_ID": "1", "$SLURM_ARRAY_TASK_COUNT": "8"}
        groups.insert(0, ("before", [shlex.split(line) for line in PREPARE]))
        count = 0
        for where, commands in groups:
            for words in commands:
                for variable, value in variables.items():
                    words = [word.replace(variable, value) for word in words]
                if any(word in NEEDS for word in words):
                    print(f"{where}: not run, it needs {NEEDS[next(w for w in words if w in NEEDS)]}: sateen {shlex.join(words)}")
                    continue
                count += 1
                run = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
                if run.returncode != 0:
                    print(f"{where}: sateen {shlex.join(words)}\n{run.stdout}{run.stderr}")
                    faults += 1
        print(f"{count} commands ran, {faults} faults")
    return faults


# Words of commands that cannot run everywhere.
NEEDS = {"live": "a camera", "calibrate": "pictures of a chessboard"}


def check_snippets(source, compiler):
    faults = 0
    count = 0
    for page in pages(source):
        for i, code in enumerate(blocks(page.read_text(), "cpp")):
            count += 1
            lines = code.splitlines()
            head = [line for line in lines if line.startswith("#include")]
            body = [line for line in lines if not line.startswith("#include")]
            if "int main(" not in code:
                body = ["void snippet() {", *body, "}"]
            text = "\n".join([*head, *body, ""])
            run = subprocess.run([*compiler, "-fsyntax-only", "-x", "c++", "-"], input=text, capture_output=True, text=True)
            if run.returncode != 0:
                print(f"{page.name}, C++ block {i + 1}:\n{run.stderr}")
                faults += 1
    print(f"{count} blocks of C++, {faults} faults")
    return faults


def anchors(text):
    names = set()
    for heading in re.findall(r"^#+ (.*)", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), re.M):
        names.add(re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-"))
    return names


def check_links(source):
    faults = 0
    count = 0
    for page in [*pages(source), *sorted(source.glob("examples/**/*.md"))]:
        text = page.read_text()
        found = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"(?:src|href)=\"([^\"]+)\"", text)
        for link in found:
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            file, _, anchor = link.partition("#")
            target = (page.parent / file) if file else page
            if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target.read_text())):
                print(f"{page.relative_to(source)}: {link} leads nowhere")
                faults += 1
    print(f"{count} links, {faults} faults")
    return faults


def main():
    what, source = sys.argv[1], Path(sys.argv[2]).resolve()
    if what == "commands":
        return check_commands(source, sys.argv[3])
    if what == "snippets":
        return check_snippets(source, sys.argv[3:])
    return check_links(source)


if __name__ == "__main__":
    sys.exit(min(main(), 1))
