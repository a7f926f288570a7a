"""The report as a list of blocks, and as one HTML page that needs nothing else: pictures are inside as
base64."""
import base64
import dataclasses
import html
import pathlib


@dataclasses.dataclass
class Heading:
    text: str
    anchor: str = ""
    level: int = 2


@dataclasses.dataclass
class Text:
    text: str


@dataclasses.dataclass
class Quote:
    """What the paper says."""
    text: str


@dataclasses.dataclass
class Table:
    header: tuple
    rows: list
    caption: str = ""


@dataclasses.dataclass
class Figure:
    path: pathlib.Path
    caption: str


@dataclasses.dataclass
class Findings:
    """Statements with what was found: rows of (verdict, statement, measured, anchor)."""
    rows: list


VERDICTS = {"holds": "#2f7d4f", "does not hold": "#b3372b", "sensitive": "#b06a00", "not given": "#5a5a8a"}

STYLE = """
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #222; max-width: 60em; margin: 2em auto;
  padding: 0 1em; }
h1 { font-size: 1.7em; line-height: 1.25; }
h2 { font-size: 1.3em; margin-top: 2.2em; border-top: 1px solid #ddd; padding-top: .8em; }
h3 { font-size: 1.05em; margin-top: 1.6em; }
blockquote { margin: 1em 0; padding: .4em 1em; border-left: 4px solid #1f5a99; background: #f2f6fa; }
blockquote b { color: #1f5a99; }
table { border-collapse: collapse; font-size: .86em; margin: 1em 0; }
caption { caption-side: top; text-align: left; padding-bottom: .4em; }
th, td { padding: .3em .7em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; }
th { background: #f4f4f4; }
figure { margin: 1.2em 0; } figure img { width: 100%; height: auto; }
figcaption { font-size: .9em; color: #444; }
.verdict { font-weight: 600; white-space: nowrap; } .wide { overflow-x: auto; }
nav { font-size: .92em; }
"""


def escaped(text):
    return html.escape(str(text), quote=True)


def _table(header, rows, caption=""):
    parts = ['<div class="wide"><table>']
    if caption:
        parts.append(f"<caption>{escaped(caption)}</caption>")
    parts.append("<tr>" + "".join(f"<th>{cell}</th>" for cell in header) + "</tr>")
    parts += ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    return "\n".join([*parts, "</table></div>"])


def _block(block):
    if isinstance(block, Heading):
        anchor = f' id="{escaped(block.anchor)}"' if block.anchor else ""
        return f"<h{block.level}{anchor}>{escaped(block.text)}</h{block.level}>"
    if isinstance(block, Text):
        return f"<p>{escaped(block.text)}</p>"
    if isinstance(block, Quote):
        return f"<blockquote><b>The paper.</b> {escaped(block.text)}</blockquote>"
    if isinstance(block, Table):
        return _table(map(escaped, block.header), [map(escaped, row) for row in block.rows], block.caption)
    if isinstance(block, Findings):
        rows = [(f'<span class="verdict" style="color:{VERDICTS[verdict]}">{escaped(verdict)}</span>',
                 escaped(statement),
                 escaped(measured), f'<a href="#{escaped(anchor)}">where</a>')
                for verdict, statement, measured, anchor in block.rows]
        return _table(("", "statement", "measured", ""), rows)
    picture = base64.b64encode(block.path.read_bytes()).decode("ascii")
    return (f'<figure><img alt="{escaped(block.caption)}" src="data:image/png;base64,{picture}">'
            f"<figcaption>{escaped(block.caption)}</figcaption></figure>")


def write_html(title, blocks, path):
    links = [f'<a href="#{escaped(b.anchor)}">{escaped(b.text)}</a>' for b in blocks
             if isinstance(b, Heading) and b.anchor]
    body = "\n".join(_block(block) for block in blocks)
    path.write_text("<!DOCTYPE html>\n"
                    f'<html lang="en"><head><meta charset="utf-8"><title>{escaped(title)}</title>\n'
                    '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                    '<link rel="icon" href="data:,">\n'  # otherwise browsers ask for one
                    f"<style>{STYLE}</style></head><body>\n<h1>{escaped(title)}</h1>\n"
                    f"<nav>{' · '.join(links)}</nav>\n{body}\n</body></html>\n", encoding="utf-8")
