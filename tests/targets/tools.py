"""Where the compiler, the linker and the emulators are, and how commands are run."""

import glob
import os
import pathlib
import shutil
import subprocess
import threading

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def output_folder():
    """Where everything is built; beside what cargo builds."""
    target = os.environ.get("CARGO_TARGET_DIR")
    base = pathlib.Path(target) if target else ROOT / "target"
    return base.absolute() / "targets"


class Failure(Exception):
    """Why a row is not well; the log says more."""

    def __init__(self, why, log=None):
        super().__init__(why)
        self.log = log


spent = {}  # processor seconds, by what they were spent on
_counting = threading.Lock()


def run(what, command, log, timeout=None, cwd=HERE, env=None):
    """Runs a command with its output in a file; gives its exit status, or None after the time."""
    with open(log, "wb") as file:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=file,
                                       stderr=subprocess.STDOUT, cwd=cwd, env=env)
        except OSError as error:
            file.write(f"{command[0]}: {error}\n".encode())
            return 127
    late = threading.Event()
    timer = threading.Timer(timeout or 1e6, lambda: (late.set(), process.kill()))
    timer.daemon = True
    timer.start()
    _, status, usage = os.wait4(process.pid, 0)
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    with _counting:
        spent[what] = spent.get(what, 0) + usage.ru_utime + usage.ru_stime
    return None if late.is_set() else process.returncode


def text_of(*command):
    """What a command prints."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise Failure(f"{command[0]} does not work: {error}") from error


def llvm(name):
    """The newest installed tool of LLVM with this name."""
    found = glob.glob(f"/usr/lib/llvm-*/bin/{name}")
    if found:
        return max(found, key=lambda path: int(path.split("llvm-")[1].split("/")[0]))
    if path := shutil.which(name):
        return path
    raise Failure(f"{name} is missing: install the packages llvm and lld, or run `install`")


def compiler():
    """A compiler that has the sources of its own core library."""
    for rustc in (shutil.which("rustc"), "/usr/bin/rustc"):
        if rustc and os.path.exists(rustc):
            sysroot = text_of(rustc, "--print", "sysroot").strip()
            if os.path.exists(f"{sysroot}/lib/rustlib/src/rust/library/core/Cargo.toml"):
                cargo = os.path.join(os.path.dirname(rustc), "cargo")
                return rustc, cargo if os.path.exists(cargo) else "cargo"
    raise Failure("no compiler with the sources of the core library: "
                  "rustup component add rust-src, or run `install`")
