"""Make the environment of the project, or add to it what one command needs: ``python3 tools/environment.py book``.

One ``.venv`` for all, and a lock for each purpose (book, lab, test, lite), all resolved against one union, so that
what one brings suits the others. uv, itself pinned with hashes, installs them; where it does not come, pip does.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = BIN / "python"
#: Building the book needs no library.
WITHOUT_LIBRARY = ("book",)


def run(*command, quiet=False):
    """Whether a command of the environment succeeds, with pip's own index and certificates for uv as well."""
    names = dict(os.environ, VIRTUAL_ENV=str(VENV), PIP_DISABLE_PIP_VERSION_CHECK="1")
    if "UV_DEFAULT_INDEX" not in names and index():
        names["UV_DEFAULT_INDEX"] = index()
    if "PIP_CERT" in names:
        names.setdefault("SSL_CERT_FILE", names["PIP_CERT"])
    out = subprocess.DEVNULL if quiet else None
    return (
        subprocess.run(
            [str(part) for part in command], cwd=ROOT, env=names, stdout=out, stderr=out
        ).returncode
        == 0
    )


def index():
    """The package index that pip is told to use, if it is told one."""
    command = [str(PYTHON), "-m", "pip", "config", "get", "global.index-url"]
    said = subprocess.run(command, capture_output=True, text=True)
    return os.environ.get("PIP_INDEX_URL") or (said.stdout.strip() if said.returncode == 0 else "")


def install(*arguments):
    """Install with uv, and where that fails with pip."""
    pip = [PYTHON, "-m", "pip", "install", "-q"]
    if not (BIN / "uv").exists() and not (BIN / "uv.exe").exists():
        run(*pip, "--require-hashes", "--only-binary", ":all:", "-r", "requirements/uv.lock", quiet=True)
    if run(BIN / "uv", "pip", "install", *arguments) if list(BIN.glob("uv*")) else False:
        return
    print("uv is not at hand or failed; pip does it, which takes a few minutes.", flush=True)
    if not run(*pip, *arguments):
        sys.exit("The packages could not be installed; the lines above say why.")


def main(purpose):
    if sys.version_info < (3, 11):
        sys.exit(
            "polyskel_lite needs Python 3.11 or newer; {} is {}.{}. Name another one, for example: "
            "make PYTHON=python3.12 {}".format(sys.executable, *sys.version_info[:2], purpose)
        )
    if not PYTHON.exists():
        print("Making the environment .venv ...", flush=True)
        subprocess.run([sys.executable, "-m", "venv", str(VENV)], check=True)
    lock = f"requirements/{purpose}.lock"
    print(f"Installing the packages of {lock} into .venv (once, half a minute) ...", flush=True)
    install("--require-hashes", "-r", lock)
    if purpose not in WITHOUT_LIBRARY:
        install("--no-deps", "--no-build-isolation", "-e", ".")
        print("Compiling the loops of the library (once, a quarter of a minute) ...", flush=True)
        run(PYTHON, "-c", "from polyskel_lite.compiling import main; main()")
    (VENV / f".{purpose}").touch()


if __name__ == "__main__":
    main(sys.argv[1])
