"""Tables of results: Markdown for people, CSV for programs."""
import csv


def row(cells):
    """A line of a Markdown table; a bar within a cell would end it."""
    return "| " + " | ".join(str(cell).replace("|", "/") for cell in cells) + " |"


def rule(columns, cell="---"):
    """The line below the header."""
    return "|" + f"{cell}|" * columns


def markdown(header, rows, cell="---", padded=False):
    """cell: of the rule, " ---: " for numbers that end at the right. padded: columns line up in a terminal
    too."""
    rows = [[str(cell) for cell in each] for each in (header, *rows)]
    if padded:
        widths = [max(map(len, column)) for column in zip(*rows)]
        rows = [[text.ljust(width) for text, width in zip(each, widths)] for each in rows]
        below = "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    else:
        below = rule(len(header), cell)
    return "\n".join([row(rows[0]), below, *map(row, rows[1:])])


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def read_csv(path):
    """Rows as dictionaries of text."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
