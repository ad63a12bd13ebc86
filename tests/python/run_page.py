"""run_page.py PAGE [MOST]: runs the blocks of a page that are marked python or bash, in their order.

Blocks of Python share one namespace, that of __main__, so that processes of concurrent.futures find their functions. A block
of more than MOST lines is an error. What the blocks leave in the namespace is then examined by what stands on standard input.
"""

import os
import re
import subprocess
import sys

if __name__ == "__main__":  # not in a process that a block starts
    page, most = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else None
    with open(page, encoding="utf-8") as file:
        blocks = re.findall(r"^```(python|bash)\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
    checks = sys.stdin.read()

    for number, (language, code) in enumerate(blocks, start=1):
        lines = [line for line in code.splitlines() if line.strip()]
        if most is not None and len(lines) > most:
            sys.exit(f"block {number} has {len(lines)} lines, more than {most}:\n{code}")
        begun = sum(os.times()[:4])
        if language == "bash":
            done = subprocess.run(["bash", "-euc", code], capture_output=True, text=True, check=False)
            print(done.stdout, end="")
            if done.returncode != 0:
                sys.exit(f"block {number} ends with {done.returncode}:\n{code}{done.stderr}")
        else:
            exec(compile(code, f"{page}, block {number}", "exec"), globals())
        print(f"[block {number}, {language}: {sum(os.times()[:4]) - begun:.2f} s]", file=sys.stderr)
    exec(compile(checks, "checks", "exec"), globals())
    print(f"{len(blocks)} blocks")
