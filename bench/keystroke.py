"""How long an editor waits for `rebsync lsp` after a keystroke, in a model of 2,000 lines.

    python bench/keystroke.py [--edits N] [--robots N]

A real client types a character into a body in the middle of the model and asks for completion, for
the outline, for what the name at the cursor is, or for the colours; then it waits for the
diagnostics. Printed are the median and the longest time of each in milliseconds, the ratio to the
goal of 100 ms, and how long the server had a processor for it (Linux only), which does not depend
on what else the machine does. The server waits 150 ms for the next keystroke before it sends
diagnostics: that is taken off the time by the clock.

With `--robots N` the model has N classes of robots, its package lies beside it, and in the code of
each other robot somebody has changed a number: the package has drifted. Between keystrokes a file
of code is saved, so that the server looks at the package again while the next ones are answered;
`drift` is the time until it tells what has drifted.
"""

from __future__ import annotations

import argparse
import asyncio
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from lsprotocol import types as lsp

from rebsync.cli import main as main_command
from rebsync.lsp.session import DELAY
from tests.lsp.client import Editor, at, editor

Question = Callable[[Editor, lsp.TextDocumentIdentifier, lsp.Position], Awaitable[object]]
Times = dict[str, list[tuple[float, float]]]  # milliseconds by the clock, and of a processor
GOAL = 100.0
CLASS = """
reactiveclass C{0}(10) {{
  knownrebecs {{
    C{1} other;
  }}
  statevars {{
    int count;
    boolean full;
    int[4] cells;
  }}
  C{0}() {{
    count = 0;
    full = false;
    self.tick();
  }}
  // counts, and tells the other
  msgsrv tick() {{
    if (count > 3 && !full) {{
      count = count + 1;
      full = count > 2;
      cells[count] = count * 2 + 7;
      other.hello(count, full) after(3);
    }} else {{
      while (count > 0) {{
        count -= 1;
        cells[0] = cells[1] + cells[2];
      }}
    }}
    self.tick() after(10);
  }}
  msgsrv hello(int x, boolean y) {{
    if (y) {{
      count = x;
    }} else {{
      full = !y;
    }}
  }}
}}
"""
CLASSES = 52
STATEMENT = "count=count+1;"  # most of the time there is only a part of it
QUESTIONS: dict[str, Question] = {
    "completion": lambda client, document, place: client.text_document_completion_async(
        lsp.CompletionParams(document, place)
    ),
    "outline": lambda client, document, place: client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(document)
    ),
    "hover": lambda client, document, place: client.text_document_hover_async(
        lsp.HoverParams(document, place)
    ),
    "colours": lambda client, document, place: client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    ),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--edits", type=int, default=20, metavar="N")
    parser.add_argument("--robots", type=int, default=0, metavar="N")
    edits, robots = (parsed := parser.parse_args()).edits, parsed.robots
    text = model(robots or CLASSES)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "large.rebeca")
        path.write_text(text, encoding="utf-8")
        times: Times = {}
        code = drifted(path) if robots else None
        asyncio.run(play(path, text, edits, times, code))
    print(f"{text.count(chr(10))} lines, {edits} keystrokes")
    for what, each in times.items():
        clock, processor = zip(*each, strict=True)
        median = statistics.median(clock)
        print(
            f"{what:12} {median:6.0f} ms, longest {max(clock):6.0f} ms, ratio {median / GOAL:.2f}, "
            f"of a processor {statistics.median(processor):4.0f} ms, "
            f"longest {max(processor):4.0f} ms"
        )


def model(count: int) -> str:
    """A ring of classes."""
    classes = "".join(CLASS.format(i, (i + 1) % count) for i in range(count))
    rebecs = "".join(f"  C{i} r{i}(r{(i + 1) % count}):();\n" for i in range(count))
    return f"{classes}\nmain {{\n{rebecs}}}\n"


def drifted(path: Path) -> Path:
    """Makes the package of a model, and edits the code of each other class; gives one of these."""
    assert main_command(["generate", str(path), "-o", str(path.parent)]) == 0
    sources = Path(path.parent, "large/src").glob("c[0-9]*.cpp")
    files = sorted(each for each in sources if not each.stem.endswith("_node"))
    for file in files[::2]:
        code = file.read_text(encoding="utf-8")
        assert "count_ + 1" in code
        file.write_text(code.replace("count_ + 1", "count_ + 2"), encoding="utf-8")
    return files[0]


async def play(path: Path, text: str, edits: int, times: Times, code: Path | None) -> None:
    async with editor(path.parent) as client:
        uri = client.open(path)
        await client.diagnostics(uri)
        middle = text.count("reactiveclass") // 2
        place = lsp.Position(at(text, f"  C{middle}() {{").line + 1, 4)
        opened = client.open(code) if code is not None else None
        number = 0
        while number < edits:
            for what, request in QUESTIONS.items():
                client.type(uri, lsp.Range(place, place), STATEMENT[number % len(STATEMENT)])
                place = lsp.Position(place.line, place.character + 1)
                number += 1
                times.setdefault(what, []).append(
                    await timed(client, request(client, lsp.TextDocumentIdentifier(uri), place))
                )
            await asyncio.sleep(3 * DELAY)
            while not client.sent.empty():  # those of earlier keystrokes, where answers took long
                client.sent.get_nowait()
            client.type(uri, lsp.Range(place, place), " ")
            waited, worked = await timed(client, client.diagnostics(uri))
            times.setdefault("diagnostics", []).append((waited - DELAY * 1000, worked))
            if code is None or opened is None:
                await asyncio.sleep(0.05)
                continue
            text_of = code.read_text(encoding="utf-8")
            code.write_text(
                re.sub(r"count_ \+ \d+", f"count_ + {number}", text_of), encoding="utf-8"
            )
            told = asyncio.create_task(timed(client, saved(client, opened)))
            client.text_document_did_save(
                lsp.DidSaveTextDocumentParams(lsp.TextDocumentIdentifier(opened))
            )
            while not told.done():
                client.type(uri, lsp.Range(place, place), " ")
                question = QUESTIONS["completion"](client, lsp.TextDocumentIdentifier(uri), place)
                times.setdefault("meanwhile", []).append(await timed(client, question))
                await asyncio.sleep(0.03)
            times.setdefault("drift", []).append(await told)


async def saved(client: Editor, uri: str) -> None:
    """Waits until the server has told what has drifted in a file."""
    while not await client.diagnostics(uri):
        pass


async def timed(client: Editor, awaited: Awaitable[object]) -> tuple[float, float]:
    """How long something takes, and how long the server works for it, in milliseconds."""
    start, worked = time.perf_counter(), processor_time(client)
    await awaited
    took = (time.perf_counter() - start) * 1000
    return took, processor_time(client) - worked


def processor_time(client: Editor) -> float:
    """How long all threads of the server had a processor so far, in milliseconds; 0 if not told."""
    tasks = Path(f"/proc/{client.process_id}/task").glob("*/schedstat")
    return sum(int(each.read_text().split()[0]) for each in tasks) / 1e6


if __name__ == "__main__":
    main()
