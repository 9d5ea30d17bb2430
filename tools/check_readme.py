"""Do what the README says in an empty environment: install with its command, then run its Python."""

import re
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def blocks() -> tuple[str, str]:
    """The command that installs the library, and the code that stands under it."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    found = re.search(r"`(pip install [^`]+)`[^`]*```python\n(.*?)```", text, re.S)
    if not found:
        sys.exit("README.md has no `pip install ...` followed by a Python block.")
    return found[1], found[2]


def main() -> int:
    command, code = blocks()
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        venv.create(home / "empty", with_pip=True)
        python = home / "empty" / ("Scripts" if sys.platform == "win32" else "bin") / "python"
        copy = home / "copy"  # of what is committed: building writes nothing beside the sources
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".venv", "_build", ".git", "tests"))
        arguments = [word.strip("\"'") for word in command.split()[1:]]
        subprocess.run([str(python), "-m", "pip", "-q", *arguments], cwd=copy, check=True)
        subprocess.run([str(python), "-c", code], cwd=home, check=True)
    print(f"The README's code runs after `{command}`.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
