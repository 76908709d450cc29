"""Writes parts of docs/VALIDATION.md anew, each between its marks; without names, all.

    make.py [PART ...]
"""

import re
import sys

import parts

PAGE = parts.ROOT / "docs" / "VALIDATION.md"


def main(names):
    for name in names:
        if name not in parts.PARTS:
            sys.exit(f"validation: there is no part {name}; there are {', '.join(parts.PARTS)}")
    parts.OUT.mkdir(parents=True, exist_ok=True)
    for name in names or parts.PARTS:
        print(name, flush=True)
        text = parts.PARTS[name]().strip()
        page = PAGE.read_text(encoding="utf-8")
        begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        made = f"{begin}\n{text}\n{end}"
        page, count = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _, made=made: made, page, flags=re.S)
        if count != 1:
            sys.exit(f"validation: {PAGE} has no marks {begin} and {end}")
        PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
