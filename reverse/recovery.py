"""From the files of a package, or some of them, to a model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.evaluation_order import out_of_order
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.build.built import unbuilt
from rebsync.reverse.build.compiled_with import compiled_with
from rebsync.reverse.build.field_order import in_order
from rebsync.reverse.build.manifests import package_name
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.files.listeners import listeners
from rebsync.reverse.files.monitors import is_monitor
from rebsync.reverse.files.packages import BESIDE, CODE
from rebsync.reverse.files.python_files import SETUP, is_launch, is_python
from rebsync.reverse.findings import Finding, Findings, Grade
from rebsync.reverse.generated.before_main import at_the_end, beside_main
from rebsync.reverse.generated.cpp_classes import Classes
from rebsync.reverse.generated.cpp_kept import Memory, read_with
from rebsync.reverse.generated.messages import OwnMessages, own_messages
from rebsync.reverse.generated.noexcept_functions import ending_the_node
from rebsync.reverse.generated.one_definition import defined_again, in_place_of_others
from rebsync.reverse.generated.parameters import odd_arguments
from rebsync.reverse.generated_system import GeneratedSystem, unit_of_time
from rebsync.reverse.graph import Graph
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.models.dead_texts import without_dead_texts
from rebsync.reverse.models.texts import enumerated, text_variables
from rebsync.reverse.nodes.node_arguments import own_arguments
from rebsync.reverse.nodes.node_components import executables
from rebsync.reverse.nodes.node_joined import Joined, Observed, Part
from rebsync.reverse.nodes.node_lacking import marked_lacking
from rebsync.reverse.nodes.node_launch import System, system_of
from rebsync.reverse.nodes.node_presence import is_generated, may_have_nodes
from rebsync.reverse.nodes.node_programs import Program, programs, with_nodes
from rebsync.reverse.nodes.node_system import Nodes, NodeSystem
from rebsync.reverse.nodes.open_ends import open_ends, with_open_servers
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.hiding_macros import hiding_macros
from rebsync.reverse.syntax.unparsed import unparsed
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.reverse.python.recovery import PythonCode, PythonPart

_CODE = tuple(sorted(CODE))
# Where none of these is, no message of std_msgs is heard.
_HEARING = ("std_msgs", "ShapeShifter", "generic_subscription", "GenericSubscription")
_UNBUILT = "no program of the package is made of this file"
_NEEDED = "no target of the build compiles this file, and the package needs what it defines"


@dataclass(frozen=True, slots=True)
class Extracted:
    """The model of some files, what in them is not in it, and how many statements each body has.

    `asking` are the calls to ROS of its C++, of which `graph` is made when it is first asked for;
    `in_python` those of its Python. `joined` are the nodes that people wrote, wired, and
    `times` those in seconds that the unit of the model's time does not divide. `texts` are those of
    the code by the numbers that they are in the model, and `text_variables` what holds one: the
    class, a server or nothing, the name.
    """

    model: m.Model
    findings: tuple[Finding, ...]
    statements: tuple[tuple[str, int], ...]
    asking: Asking = field(default_factory=lambda: Asking(Code()), compare=False, repr=False)
    in_python: Graph = field(default_factory=Graph, compare=False, repr=False)
    joined: Joined = field(default_factory=lambda: Joined.of(()), compare=False, repr=False)
    times: frozenset[Fraction] = field(default=frozenset(), compare=False)
    texts: tuple[str, ...] = ()
    text_variables: frozenset[tuple[str, str, str]] = frozenset()

    @property
    def graph(self) -> Graph:
        """What the code asks of ROS."""
        in_cpp, in_python = self.asking.graph, self.in_python
        return Graph(in_cpp.facts + in_python.facts, in_cpp.unmodelled + in_python.unmodelled)


def extract(
    files: Mapping[str, Source],
    only: str | None = None,
    memory: Memory | None = None,
    observed: Observed | None = None,
    environment: str | None = None,
    texts: Sequence[str] = (),
) -> Extracted:
    """The model that files say together; paths are relative to the package, with slashes.

    With `only` the classes that this file declares or defines, read with the help of the others;
    or, if it is a launch file, the system that this one starts. `memory` knows what generated
    classes said before: of these only what an edit can have to do with is read again. Of topics
    that are `observed` the model sends what nodes publish to an observer, too. `environment` is a
    program in Python among the files that is started beside what is launched. `texts` are those
    whose numbers are known.
    """
    findings = Findings()
    beside = listeners(files)
    files = {n: s for n, s in files.items() if n == only or not (is_monitor(n, s) or n in beside)}
    files = _built(files, only, findings)
    at = _Reading.of(files, only, findings, environment)
    listed, declared = Findings(), own_messages(files)
    in_python = _in_python(files, listed, declared)
    classes = at.classes(declared, in_python)
    read = at.generated(classes, memory)
    in_cpp = at.nodes_in_cpp()
    people = in_cpp.find() if in_cpp is not None else None
    part = replace(people.part if people is not None else Part.empty(), observed=observed or {})
    python = at.python(in_python, listed, part, classes) if in_python is not None else None
    joined = (python.nodes.joined if python is not None else None) or Joined.of([part])
    nodes = Nodes((), (), False)
    if in_cpp is not None and people is not None:
        nodes = in_cpp.read(people, joined)
    if read or nodes.classes or (python is not None and python.classes):
        at.note_launch(python, is_by_hand=bool(nodes.classes))
    findings.take(listed)
    if read or (python is not None and python.classes):
        at.list_launch_effects()
    if python is not None:
        read = (*read, *python.classes)
        nodes = nodes.beside(python.nodes.classes, python.nodes.rebecs)
    text_names = frozenset(v for c in nodes.classes for v in text_variables(c))
    nodes, known_texts = _without_texts(nodes, texts)
    system = GeneratedSystem(at.code, classes, read, at.launched, at.programs, python)
    main = _main(system, nodes, at.only is not None and len(files) > 1)
    findings.all += out_of_order((*read, *nodes.classes), findings.ordered)
    lacking = (marked_lacking(c, findings.all) for c in nodes.classes)
    of_people = with_open_servers(lacking, open_ends(joined))
    return Extracted(
        m.Model(tuple(system.heads() if read else ()), (*read, *of_people), main),
        tuple(findings.all),
        tuple(findings.statements.items()),
        at.asking,
        python.graph if python is not None else Graph(),
        joined,
        frozenset(findings.times),
        tuple(known_texts),
        text_names,
    )


@dataclass(frozen=True, slots=True)
class _Reading:
    """Some files, and what is known of all of them before a class is read.

    `only` is the one file that is asked for, unless that is the launch file of `system`.
    """

    files: Mapping[str, Source]
    only: str | None
    code: Code
    asking: Asking
    package: str
    programs: tuple[Program, ...]
    system: System | None
    findings: Findings

    @staticmethod
    def of(
        files: Mapping[str, Source],
        only: str | None,
        findings: Findings,
        environment: str | None = None,
    ) -> _Reading:
        """The files, parsed, with the programs that they are built to and the system they start."""
        code = _in_cpp(files, findings)
        package = package_name(files)
        asked = only if only is not None and is_launch(only) else None
        started = programs(code, files)
        system = system_of(files, package, asked, started)
        if system is not None and environment is not None:
            system = system.beside(environment)
        left = only if asked is None else None
        return _Reading(files, left, code, Asking(code), package, started, system, findings)

    @property
    def launch(self) -> Launch | None:
        """What is started, if a launch file says it."""
        return self.system.launch if self.system is not None else None

    @property
    def launched(self) -> Launch | None:
        """What is started, unless one file of code is asked for."""
        return self.launch if self.only is None else None

    def list_launch_effects(self) -> None:
        """Lists what launch files in Python do that start generated nodes."""
        sources = self.launched.sources if self.launched is not None else ()
        for source in (s for s in sources if s.path.endswith(".py")):
            from rebsync.reverse.python.generated.import_effects import list_launch_effects

            list_launch_effects(source, self.findings)

    def classes(self, declared: OwnMessages, in_python: PythonCode | None) -> Classes:
        """The classes of C++ that may be generated; `declared` are the package's own messages."""
        orders = in_python.orders() if in_python is not None else ()
        families = in_python.classes.families() if in_python is not None else {}
        messages = in_order(declared.fields, orders)
        types = {t.rpartition("/")[2]: tuple(f.values()) for t, f in messages.items()}
        unit, served = unit_of_time(self.launch), Served(families, types)
        alone = in_python is None or not in_python.hears_others()
        return Classes(
            self.code,
            self.findings,
            messages,
            unit,
            served,
            alone=alone,
            signed=declared.signed,
        )

    def generated(
        self, classes: Classes, memory: Memory | None
    ) -> tuple[m.ReactiveClass | m.Interface, ...]:
        """Those classes that are generated, read, with what is odd around them listed."""
        wanted = None
        if self.only is not None:
            wanted = _classes_in(self.code, self.files[self.only].path)
        read = classes.read(wanted) if memory is None else read_with(memory, classes, wanted)
        chosen = tuple(classes.chosen(wanted))
        for owner in chosen:
            self.findings.all += defined_again(self.code, owner)
            self.findings.all += at_the_end(self.code, owner)
        if chosen:
            self.findings.all += beside_main(self.code)
            self.findings.all += in_place_of_others(self.code)
            self.findings.all += ending_the_node(self.code, classes.form)
        names = {owner.name for owner in chosen}
        for program in self.programs:
            self.findings.all += odd_arguments(self.code, program.main, names)
        return read

    def nodes_in_cpp(self) -> NodeSystem | None:
        """The nodes of C++ that people wrote, if there may be any."""
        generated = is_generated(self.code)
        if generated and not may_have_nodes(self.code, self.asking, self.programs):
            return None
        graph = self.asking.graph
        found = with_nodes(self.programs, graph)
        launch = self.launch if self.system is not None and self.system.starts else None
        return NodeSystem(
            self.code,
            graph,
            self.files,
            launch,
            self.package,
            found,
            self.findings,
            self.only,
            generated,
        )

    def python(
        self, code: PythonCode, findings: Findings, beside: Part, in_cpp: Classes
    ) -> PythonPart:
        """What the files of Python say; what of them is not in the model is listed."""
        from rebsync.reverse.python.recovery import by_name, read_python

        names = {name for p in self.programs for name in (p.name, p.stem)}
        names = names.union(*executables(self.files).values())
        known = code.classes.messages.constants
        code.classes.messages = by_name(OwnMessages(in_cpp.messages, in_cpp.signed, known))
        return read_python(
            code,
            findings,
            self.only,
            self.files,
            self.package,
            self.launch,
            beside,
            names,
            in_cpp.served,
        )

    def note_launch(self, python: PythonPart | None, *, is_by_hand: bool) -> None:
        """Lists what of the launch files is not in the model, where these are asked for."""
        if self.system is None or self.only is not None:
            return
        by_python = python is not None and not is_by_hand and python.starts(self.system.launch)
        self.system.note(self.findings, by_python)


def _without_texts(nodes: Nodes, known: Sequence[str]) -> tuple[Nodes, list[str]]:
    """The nodes with numbers for texts, and the texts by their numbers."""
    live = without_dead_texts(nodes.classes, nodes.rebecs)
    parts: list[m.ReactiveClass | m.Rebec] = [*live[0], *live[1]]
    done, texts = enumerated(parts, known)
    classes = tuple(p for p in done if isinstance(p, m.ReactiveClass))
    rebecs = tuple(p for p in done if isinstance(p, m.Rebec))
    return replace(nodes, classes=classes, rebecs=rebecs), texts


def _built(files: Mapping[str, Source], only: str | None, findings: Findings) -> dict[str, Source]:
    """The files but for those that no program is made of, which are listed."""
    found = unbuilt(files)
    for path in sorted(found.left - found.tests - {only}):
        grade, why = Grade.UNBUILT, _UNBUILT
        if path in found.needed:
            grade, why = Grade.UNREADABLE, _NEEDED
        findings.all.append(Finding(grade, files[path], NOWHERE, why))
    left = found.left - found.needed - {only}
    return {path: source for path, source in files.items() if path not in left}


def _in_cpp(files: Mapping[str, Source], findings: Findings) -> Code:
    """The files of C++, parsed."""
    trees = [
        parse(source, path.startswith(BESIDE))
        for path, source in sorted(files.items())
        if path.endswith(_CODE)
    ]
    findings.all += [finding for tree in trees for finding in unparsed(tree)]
    defined, odd = compiled_with(files)
    findings.all += odd
    code = Code.of(trees if defined is None else [*trees, parse(defined)])
    findings.all += (*hiding_macros(code), *own_arguments(code))
    return code


def _in_python(
    files: Mapping[str, Source],
    findings: Findings,
    messages: OwnMessages,
) -> PythonCode | None:
    """The files of Python, if there are any, and what of them is generated."""
    code = ((path, source) for path, source in files.items() if path != SETUP)
    sources = {path: source for path, source in code if is_python(path, source)}
    if not sources:
        return None
    from rebsync.reverse.python.recovery import PythonCode

    in_cpp = [source.text for path, source in files.items() if path.endswith(_CODE)]
    found = PythonCode.of(sources, findings, messages)
    found.code.alone = not any(word in text for text in in_cpp for word in _HEARING)
    return found


def _main(generated: GeneratedSystem, nodes: Nodes, is_part: bool) -> m.Main | None:
    """The rebecs of all nodes; None where only part of a system is asked for, or nothing starts."""
    main = generated.main()
    if is_part or (main is None and not nodes.starts):
        return None
    return m.Main((*(main.rebecs if main is not None else ()), *nodes.rebecs))


def _classes_in(code: Code, path: str) -> set[str]:
    """The classes of which a file has at least a part."""
    found = {c.name for c in code.classes.values() if c.cpp.source.path == path}
    parts = (f for all_of in code.definitions.values() for f in all_of)
    return found | {f.owner for f in parts if f.cpp.source.path == path and f.owner}
