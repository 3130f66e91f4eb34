"""What is proved of a linked image by looking at it: which symbols and instructions it holds, that
no function calls itself by any way round, and how much stack it can need."""

import re

from tools import Failure, llvm, text_of

UNWELCOME = re.compile(r"panic|unwrap_failed|expect_failed|core::fmt|alloc::|__rust_alloc|__rust_"
                       r"dealloc|__rg_|__rdl_|\bmalloc\b|\bfree\b")
# The compiler's own functions for numbers with a fraction, where the processor has none.
SOFT_FLOAT = re.compile(r" (__aeabi_[fd]\w+|__aeabi_u?[il]2[fd]|__aeabi_[il]\w*2[fd]"
                        r"|__(add|sub|mul|div|neg)[sdt]f\d|__(eq|ne|lt|le|gt|ge|unord|cmp)[sdt]f2"
                        r"|__fix(uns)?[sdt]f[sdt]i|__float(un)?[sdt]i[sdt]f"
                        r"|__(extend|trunc)[sdth]f[sdth]f2|__pow[sd]f2|(fma|sqrt|floor|fmod)f?)$", re.M)

# Instructions that compute with floats, by architecture; moves, loads and stores of whole
# registers are none, for they also copy what is no number.
FLOAT = {
    "thumb": r"v(add|sub|n?mul|div|sqrt|cmpe?|cvt[abnmprt]?|n?ml[as]|neg|abs|f?n?m[as]|rint\w|max\w*|min\w*|sel\w+)(\.\w+)*\.f(16|32|64)\b.*",
    "riscv": r"f(add|sub|mul|div|sqrt|n?madd|n?msub|min|max|cvt|eq|lt|le|class|sgnj[nx]?)\.\w.*",
    "x86": r"(v?(add|sub|mul|div|sqrt|min|max|cmp|u?comi|cvt\w*2|round|hadd)(ss|sd|ps|pd|si)\w*|cvt\w+"
           r"|f(add|sub|mul|div|sqrt|ld|st|ild|ist|com|ucom|chs|abs|prem|scale|xch)\w*)\b.*",
    "aarch64": r"(f(add|sub|n?mul|div|sqrt|n?madd|n?msub|mla|mls|min|max|minnm|maxnm|ccmpe?|cmpe?|csel|cvt\w*|rint\w)|[su]cvtf)\b.*",
    "s390x": r"(([asmdck]|me|sq|ma|ms|l[tcnp]|ld|le|fi|mx?d)[edx]br?a?|c[fgdel]{1,2}[edfg]br?a?|wf\w+|vf[asmdc]\w*|vfs\w+)\b.*",
    "ppc": r"(f(add|sub|mul|div|sqrt|n?madd|n?msub|cmp[uo]|ctiw|ctid|cfid|rsp|re|rsqrte|sel|neg|abs)[su]?\w?\w?|x[sv](add|sub|mul|div|sqrt|cmp|cv|n?m[as]|max|min|neg|abs)\w*[ds]p\w*)\b.*",
    "mips": r"(add|sub|mul|div|sqrt|neg|abs|n?madd|n?msub|c\.\w+|cmp\.\w+\.|cvt\.\w|trunc\.\w|floor\.\w)\.[sd]\b.*",
    "loongarch": r"(f(add|sub|n?mul|div|sqrt|n?madd|n?msub|max|min|abs|neg|cmp\.\w+|cvt|tint\w*|int)\.\w.*)",
    "wasm": r"f(32|64)\.(?!load|store|const|reinterpret|select)\w+.*|f(32|64)x\d\.\w+.*",
}

# Calls whose target is a value, not a place in the program.
INDIRECT = {
    "thumb": r"(blx\s+r\d+|blx\s+(ip|sp|lr)|bx\s+(?!lr)\w+)",
    "riscv": r"(c\.jalr\s+.*|jalr\s+(?!.*<).*)",
    "x86": r"call\w*\s+\*.*",
    "aarch64": r"blr\s+.*",
    "s390x": r"basr\s+%r14.*",
    "wasm": r"call_indirect.*",
    "loongarch": r"jirl\s+\$ra,\s*\$(?!ra).*",
}


def architecture(target):
    """How the instructions of a target are written."""
    starts = {"thumb": "thumb", "arm": "thumb", "riscv": "riscv", "x86_64": "x86", "i686": "x86",
              "i586": "x86", "aarch64": "aarch64", "s390x": "s390x", "powerpc": "ppc",
              "mips": "mips", "loongarch": "loongarch", "wasm": "wasm"}
    return next(kind for start, kind in starts.items() if target.startswith(start))


class Image:
    """A linked image, taken apart."""

    def __init__(self, path, target):
        self.path = path
        self.kind = architecture(target)
        self.bare = "-none" in target
        self.symbols = text_of(llvm("llvm-nm"), "-C", str(path))
        self.functions = {}  # name -> lines of code
        ends, here, end = self.ends(), None, None
        options = ["-d", "--no-show-raw-insn"]
        for line in text_of(llvm("llvm-objdump"), *options, str(path)).splitlines():
            # Some compilers leave local labels in the midst of a function.
            if head := re.fullmatch(r"[0-9a-f]+ <(?!\.L)(.+)>:", line):
                here, end = self.functions.setdefault(head.group(1), []), ends.get(head.group(1))
            elif here is not None and (code := re.match(r"\s*([0-9a-f]+):\s+(\S.*)", line)):
                # What lies between functions is no code, though it may look like some.
                if end is None or int(code.group(1), 16) < end:
                    here.append(code.group(2))

    def ends(self):
        """Where each function ends whose size is on record."""
        rows = re.findall(r"^([0-9a-f]+) ([0-9a-f]+) \w (\S+)$",
                          text_of(llvm("llvm-nm"), "-S", str(self.path)), re.M)
        odd = 1 if self.kind == "thumb" else 0
        return {name: (int(at, 16) & ~odd) + int(size, 16) for at, size, name in rows
                if int(size, 16)}

    def address(self, name):
        """Where a function begins."""
        found = re.search(rf"^([0-9a-f]+) \w {name}$", self.symbols, re.M)
        if not found:
            raise Failure(f"the image has no {name}")
        at = int(found.group(1), 16)
        return at & ~1 if self.kind == "thumb" else at

    def sections(self):
        """The bytes in flash and in RAM, without the stack."""
        flash = ram = 0
        for line in text_of(llvm("llvm-size"), "-A", str(self.path)).splitlines():
            row = re.match(r"(\.\w+)\S*\s+(\d+)\s+(\d+)", line)
            if not row:
                continue
            name, size = row.group(1), int(row.group(2))
            if name in (".text", ".rodata", ".data", ".ARM", ".eh_frame", ".vectors"):
                flash += size
            if name in (".data", ".bss"):
                ram += size
        return flash, ram

    def check_symbols(self, fixed):
        """No panic, no formatting, no allocator; for fixed point no software floats."""
        if "tracing_begins" not in self.symbols:
            raise Failure("the image is empty")
        if found := UNWELCOME.search(self.symbols):
            raise Failure(f"the image holds {found.group(0)}")
        if fixed and (found := SOFT_FLOAT.search(self.symbols)):
            raise Failure(f"the image holds {found.group(1)}")

    def float_instructions(self):
        """The instructions that compute with floats."""
        pattern = re.compile(FLOAT[self.kind])
        return [f"{name}: {line}" for name, lines in self.functions.items() for line in lines
                if pattern.match(line)]

    def calls(self):
        """Which functions each function goes to, by call or jump, and the calls by value."""
        indirect = re.compile(INDIRECT[self.kind]) if self.kind in INDIRECT else None
        edges, by_value = {}, []
        for name, lines in self.functions.items():
            to = edges.setdefault(name, set())
            for line in lines:
                at = re.search(r"<([^>]+?)(\+0x[0-9a-f]+)?>", line)
                if at and at.group(1) in self.functions:
                    itself = at.group(1) == name
                    if not itself or (not at.group(2) and re.match(r"(bl|call|jal|bras)", line)):
                        to.add(at.group(1))
                elif indirect and indirect.match(line):
                    by_value.append(f"{name}: {line}")
        return edges, by_value

    def frames(self):
        """The size of the stack frame of each function."""
        sizes = {}
        for line in text_of(llvm("llvm-readelf"), "--stack-sizes", str(self.path)).splitlines():
            if row := re.fullmatch(r"\s*(\d+)\s+(\S.*)", line):
                for name in row.group(2).split(", "):
                    sizes[name] = max(int(row.group(1)), sizes.get(name, 0))
        return sizes

    def deepest(self, root):
        """The most stack that a function and all that it calls can need: the greatest sum of frames
        along a chain of calls. Of a function written in assembler, without a size on record, what
        it pushes is counted.

        Fails where a chain of calls leads back to where it was, or goes by value."""
        edges, by_value = self.calls()
        if by_value:
            raise Failure(f"a call by value in {by_value[0]}")
        sizes = self.frames()
        best, active = {}, []

        def visit(name):
            if name in best:
                return best[name]
            if name in active:
                raise Failure("recursion: " + " -> ".join(active[active.index(name):] + [name]))
            active.append(name)
            below = max((visit(callee) for callee in edges.get(name, ())), default=0)
            active.pop()
            size = sizes.get(name)
            best[name] = below + (pushed(self.functions[name]) if size is None else size)
            # A call on x86 pushes the way back, which frames do not count.
            if self.kind == "x86":
                best[name] += 8
            return best[name]

        return visit(root)


def pushed(lines):
    """The bytes that a function in assembler puts onto the stack, at most."""
    total = 0
    for line in lines:
        if row := re.match(r"(?:push|stmdb\s+sp!,)\S*\s+\{(.+)\}", line):
            total += sum(8 if reg.strip().startswith("d") else 4 for reg in row.group(1).split(","))
        elif row := re.match(r"sub\S*\s+sp,\s*(?:sp,\s*)?#(0x[0-9a-f]+|\d+)", line):
            total += int(row.group(1), 0)
        elif row := re.match(r"(?:c\.)?addi\S*\s+sp,\s*(?:sp,\s*)?-(0x[0-9a-f]+|\d+)", line):
            total += int(row.group(1), 0)
    return total
