#!/usr/bin/env python3
"""Made the first src/kardan/io/deck/schema/keywords.tsv; since then the table is edited by hand.

usage: make_keyword_table.py CARDS_TSV FACTS_TSV OUTPUT

CARDS_TSV holds the card layouts of pydyna (MIT licence): keyword, card, "name:TypeColumn+Width[=default] ..." per line.
FACTS_TSV (tools/keyword_facts.tsv) holds, in the table's own format, the rows that Kardan honours with the cards that
pydyna lacks, "@NAME card" where a card is to be copied from CARDS_TSV, and rules "?PREFIX" for whole families.
"""
import re
import sys

SPELLING = {"MAT_MOONEY_RIVLIN_RUBBER": "MAT_MOONEY-RIVLIN_RUBBER"}


def read_cards(path):
    cards = {}
    with open(path, encoding="utf-8") as file:
        next(file)
        for line in file:
            name, card, fields = line.rstrip("\n").split("\t")
            if re.match(r"^[A-Z0-9_-]+$", name):
                cards.setdefault(name, {})[card] = fields
    return cards


def main():
    cards = read_cards(sys.argv[1])
    rules, rows, known = [], [], {}
    with open(sys.argv[2], encoding="utf-8") as file:
        for line in file:
            line = line.rstrip("\n")
            if not line or line.startswith("#"):
                rows.append(line)
            elif line.startswith("?"):
                rules.append(line[1:].split("\t"))
            elif line.startswith("\t@"):  # copy: @SOURCE card [as name] [field edits old=new]
                words = line[2:].split()
                source, card = words[0], words[1]
                name = words[3] if len(words) > 3 and words[2] == "as" else card
                rows.append(f"\t{name}\t{cards[source][card]}")
            else:
                rows.append(line)
                if not line.startswith("\t"):
                    columns = line.split("\t")
                    names = columns[0].split("=")
                    for name in names:
                        known[name] = columns[2].split() if len(columns) > 2 else []

    def covered(name):
        for known_name, options in known.items():
            rest = name[len(known_name):]
            if name.startswith(known_name) and (not rest or rest[0] == "_"):
                while rest:
                    option = next((o for o in sorted(options + ["TITLE", "ID"], key=len, reverse=True)
                                   if rest == "_" + o or rest.startswith("_" + o + "_")), None)
                    if option is None:
                        break
                    rest = rest[len(option) + 1:]
                if not rest:
                    return True
        return False

    generated = []
    for name in sorted(set(cards) | set(SPELLING.values())):
        if covered(name):
            continue
        for prefix, status, note in rules:
            if re.match(prefix, name):
                generated.append(f"{name}\t{status}\t\t{note}")
                break
        else:
            generated.append(f"{name}\tstops\t\tnot built; leaving it out would change the physics")
    with open(sys.argv[3], "x", encoding="utf-8") as file:
        file.write("\n".join(rows) + "\n\n# Known keywords of other families\n" + "\n".join(generated) + "\n")


main()
