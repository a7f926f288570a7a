"""The report's blocks as a PDF of A4 pages, set by matplotlib: text wrapped by its measured width, tables,
pictures."""
import functools

import matplotlib.image
import matplotlib.pyplot as plt
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.font_manager import FontProperties, findfont, get_font

from . import document

WIDTH, HEIGHT, MARGIN = 595.0, 842.0, 48.0  # points
LINE = 1.35  # of the font's size
SIZES = {1: 16, 2: 13, 3: 10.5}
TEXT_SIZE, TABLE_SIZE = 9.0, 7.4
NARROW = 62.0  # points: columns of a table up to this wide are not shrunk


@functools.cache
def _font(bold):
    return get_font(findfont(FontProperties(weight="bold" if bold else "normal")))


@functools.cache
def _word_width(word, size, bold):
    font = _font(bold)
    font.set_size(size, 72)
    font.set_text(word, 0.0)
    return font.get_width_height()[0] / 64


def wrapped(text, size, width, bold=False):
    """Lines of words no wider than `width` points."""
    blank = 0.32 * size
    lines, line, used = [], [], 0.0
    for word in str(text).split():
        long = _word_width(word, size, bold)
        if line and used + blank + long > width:
            lines.append(" ".join(line))
            line, used = [], 0.0
        used += long + (blank if line else 0)
        line.append(word)
    return lines + ([" ".join(line)] if line else []) or [""]


class Pages:
    """Puts things below one another and starts a page when one does not fit."""

    def __init__(self, pdf):
        self.pdf, self.figure, self.number = pdf, None, 0
        self.new_page()

    def new_page(self):
        self.finish_page()
        self.figure = plt.figure(figsize=(WIDTH / 72, HEIGHT / 72))
        self.number += 1
        self.y = HEIGHT - MARGIN
        self.figure.text(0.5, 22 / HEIGHT, str(self.number), ha="center", fontsize=7.5, color="#777777")

    def finish_page(self):
        if self.figure is not None:
            self.pdf.savefig(self.figure)
            plt.close(self.figure)

    def room(self, height):
        if self.y - height < MARGIN:
            self.new_page()

    def line(self, text, x, size, bold=False, colour="#222222"):
        self.figure.text(x / WIDTH, (self.y - size) / HEIGHT, text.replace("$", r"\$"), fontsize=size,
                         color=colour,
                         fontweight="bold" if bold else "normal", va="baseline")

    def paragraph(self, text, size=TEXT_SIZE, bold=False, colour="#222222", indent=0.0, before=5.0, keep=0.0):
        lines = wrapped(text, size, WIDTH - 2 * MARGIN - indent, bold)
        self.y -= before
        self.room(min(len(lines), 2) * LINE * size + keep)
        for line in lines:
            self.room(LINE * size)
            self.line(line, MARGIN + indent, size, bold, colour)
            self.y -= LINE * size

    def table(self, header, rows, colours=None):
        """Columns as wide as what stands in them asks for, shrunk together when the page is too narrow."""
        columns = list(zip(*[header, *rows]))
        wanted = [min(230.0, max(sum(_word_width(w, TABLE_SIZE, True) + 0.35 * TABLE_SIZE
                                     for w in str(c).split())
                                 for c in column)) + 8 for column in columns]
        total, room = sum(wanted), WIDTH - 2 * MARGIN
        narrow = sum(w for w in wanted if w <= NARROW)  # these keep their width
        shrink = min(1.0, (room - narrow) / (total - narrow)) if total > narrow else 1.0
        widths = [w if w <= NARROW else w * shrink for w in wanted]
        self.y -= 5
        for k, row in enumerate([header, *rows]):
            cells = [wrapped(cell, TABLE_SIZE, width - 6, bold=k == 0) for cell, width in zip(row, widths)]
            height = max(map(len, cells)) * LINE * TABLE_SIZE + 4
            self.room(height + (2 * height if k == 0 else 0))
            top, x = self.y, MARGIN
            for column, (lines, width) in enumerate(zip(cells, widths)):
                colour = colours[k - 1] if colours and k and column == 0 else "#222222"
                for line in lines:
                    self.line(line, x, TABLE_SIZE, bold=k == 0 or (bool(colours) and column == 0),
                              colour=colour)
                    self.y -= LINE * TABLE_SIZE
                self.y, x = top, x + width
            self.y = top - height
            rule = plt.Line2D((MARGIN / WIDTH, (MARGIN + sum(widths)) / WIDTH), [(self.y + 1) / HEIGHT] * 2,
                              color="#999999" if k == 0 else "#dddddd", linewidth=0.6)
            self.figure.add_artist(rule)
        self.y -= 4

    def picture(self, path, caption):
        image = matplotlib.image.imread(path)
        width = WIDTH - 2 * MARGIN
        height = width * image.shape[0] / image.shape[1]
        lines = wrapped(caption, 8, width)
        most = HEIGHT - 2 * MARGIN - len(lines) * LINE * 8 - 12
        if height > most:
            width, height = width * most / height, most
        self.y -= 6
        self.room(height + len(lines) * LINE * 8)
        axes = self.figure.add_axes(((WIDTH - width) / 2 / WIDTH, (self.y - height) / HEIGHT, width / WIDTH,
                                     height / HEIGHT))
        axes.imshow(image, aspect="auto", interpolation="none")
        axes.axis("off")
        self.y -= height
        self.paragraph(caption, 8, colour="#444444", before=2)

    def block(self, block):
        if isinstance(block, document.Heading):
            self.paragraph(block.text, SIZES[block.level], bold=True, before=14 if block.level == 2 else 9,
                           keep=90)
        elif isinstance(block, document.Text):
            self.paragraph(block.text)
        elif isinstance(block, document.Quote):
            self.paragraph("The paper. " + block.text, colour="#1f5a99", indent=12)
        elif isinstance(block, document.Table):
            if block.caption:
                self.paragraph(block.caption, 8, colour="#444444", keep=60)
            self.table(block.header, block.rows)
        elif isinstance(block, document.Findings):
            self.table(("", "statement", "measured"), [row[:3] for row in block.rows],
                       [document.VERDICTS[row[0]] for row in block.rows])
        else:
            self.picture(block.path, block.caption)


def write_pdf(title, blocks, path):
    with PdfPages(path, metadata={"Title": title}) as pdf:
        pages = Pages(pdf)
        pages.paragraph(title, SIZES[1], bold=True, before=0)
        for block in blocks:
            pages.block(block)
        pages.finish_page()
