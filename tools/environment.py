"""Make the environment, or add to it what one command needs: ``python3 tools/environment.py book``.

One ``.venv`` for all, and a lock for each purpose: book, lab, lite, test. All are resolved against one
union, so what one brings suits the others. uv, pinned with hashes as well, installs them; where it fails,
pip does.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / ".venv" / ("Scripts" if os.name == "nt" else "bin")
PYTHON = str(BIN / "python")


def settings() -> dict[str, str]:
    """The variables of this process, and pip's own index and certificates told to uv."""
    names = os.environ | {"VIRTUAL_ENV": str(BIN.parent), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    command = [PYTHON, "-m", "pip", "config", "get", "global.index-url"]
    index = (
        names.get("PIP_INDEX_URL") or subprocess.run(command, capture_output=True, text=True).stdout.strip()
    )
    if index:
        names.setdefault("UV_DEFAULT_INDEX", index)
    if "PIP_CERT" in names:
        names.setdefault("SSL_CERT_FILE", names["PIP_CERT"])
    return names


def works(*command: str) -> bool:
    """Whether a command succeeds; one that is not there does not."""
    try:
        return subprocess.run(command, cwd=ROOT, env=settings()).returncode == 0
    except FileNotFoundError:
        return False


def install(*arguments: str) -> None:
    """Install with uv, and where that fails with pip."""
    uv, pip = str(BIN / "uv"), (PYTHON, "-m", "pip", "install", "-q")
    if not works(uv, "-q", "--version"):
        works(*pip, "--require-hashes", "--only-binary", ":all:", "-r", "requirements/uv.lock")
    if works(uv, "pip", "install", *arguments):
        return
    print("uv is not here, or failed. pip does the same in some minutes.", flush=True)
    if not works(*pip, *arguments):
        sys.exit("The packages could not be installed; the lines above say why.")


def main(purpose: str) -> None:
    if not Path(PYTHON).exists():
        print("Making the environment .venv ...", flush=True)
        subprocess.run([sys.executable, "-m", "venv", str(BIN.parent)], check=True)
    lock = f"requirements/{purpose}.lock"
    print(f"Installing the packages of {lock} into .venv (once, half a minute) ...", flush=True)
    install("--require-hashes", "-r", lock)
    if purpose != "book":  # which is built without the library
        install("--no-deps", "--no-build-isolation", "-e", ".")
    if purpose in ("lab", "test"):
        print("Compiling the loops of the library (once, a quarter of a minute) ...", flush=True)
        works(PYTHON, "-c", "from polyskel_lite.compiling import main; main()")
    (BIN.parent.parent / ".venv" / f".{purpose}").touch()


if __name__ == "__main__":
    main(sys.argv[1])
