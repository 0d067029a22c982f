"""Rows of text as aligned columns and as Markdown tables."""


def columns(header: tuple[str, ...], rows: list[tuple[str, ...]]) -> list[str]:
    """Aligned lines: names left, numbers right, units below the headings."""
    headings = [name.partition(" (") for name in header]
    units = tuple(f"({rest}" if rest else "" for _, _, rest in headings)
    lines = [tuple(name for name, _, _ in headings), units, *rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        "  ".join(
            cell.rjust(width) if place else cell.ljust(width)
            for place, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        for line in lines
    ]


def table(header: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    """A Markdown table."""
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join("| " + " | ".join(line).strip() + " |" for line in lines)
