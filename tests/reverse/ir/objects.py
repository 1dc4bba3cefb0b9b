"""The interpreter with objects that are values: construction and destruction, places, copies."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Class, FunctionKind, Program
from tests.reverse.ir.control import Jump, Run
from tests.reverse.ir.evaluation import BINARY, Frame, Value, converted, wrapped
from tests.reverse.ir.interpreter import Interpreter
from tests.reverse.ir.memory import Alias, Captured, Object, Pointer, Thrown
from tests.reverse.ir.standard_library import FUNCTIONS, METHODS, text_method

_DESTRUCTOR = "~"


class ObjectInterpreter(Interpreter):
    """Runs programs of any language; `is_reversed` is how parts without an order are run."""

    def __init__(self, program: Program, is_reversed: bool = False) -> None:
        super().__init__(program)
        self.is_reversed = is_reversed
        self.statics: dict[str, Object] = {}
        self.notes: list[str] = []

    # --- expressions -----------------------------------------------------------------------------

    def _eval(self, expression: e.Expression, frame: Frame) -> Value:
        match expression:
            case e.Local(name) if isinstance(frame.locals.get(name), Alias):
                return self._read(frame.locals[name].pointer)
            case e.Attribute(e.ClassReference(class_), name) if class_ not in self.classes:
                self.note("read attribute", class_, name)
                return self._static(class_).fields[name]
            case e.Attribute(holder, name):
                found = self.eval(holder, frame)
                if isinstance(found, Object):
                    self.note("read attribute", found, name)
                    return found.fields[name]
                return self.attribute(found, name)
            case e.Index(holder, index) if not expression.dynamic and not expression.from_end:
                return self._element(expression, holder, index, frame)
            case e.Dereference(reference):
                return self._led_to(self.eval(reference, frame))
            case e.AddressOf(target):
                return self._address(target, frame)
            case e.Copy(operand, type_) | e.Move(operand, type_):
                return self._copy(self.eval(operand, frame), type_)
            case e.Build(t.Array(), elements):
                return [self.eval(x, frame) for x in elements]  # type: ignore[arg-type]
            case e.BuildRecord(type_, fields):
                return Object(type_.name, {n: self.eval(v, frame) for n, v in fields})
            case e.FunctionReference(name):
                return lambda *arguments: self._called(name, arguments)
            case e.Binary(Operator.SAME | Operator.NOT_SAME, left, right) if not expression.dynamic:
                same = _same(self.eval(left, frame), self.eval(right, frame))
                return same is (expression.operator is Operator.SAME)
            case e.Binary(operator, left, right) if not expression.dynamic:
                value = BINARY[operator](self.eval(left, frame), self.eval(right, frame))
                return wrapped(value, expression.type)
            case e.Convert(conversion, operand, type_) if not expression.dynamic:
                return converted(conversion, self.eval(operand, frame), type_)
            case _:
                return super()._eval(expression, frame)

    def _element(
        self, expression: e.Index, holder: e.Expression, index: e.Expression, frame: Frame
    ) -> Value:
        container, key = self.eval(holder, frame), self.eval(index, frame)
        self.note("read element", container, key)
        if not isinstance(container, dict):
            assert 0 <= key < len(container), "an element that is not there"
        found = container[key]
        is_character = isinstance(container, str) and isinstance(expression.type, t.Integer)
        return ord(found) if is_character else found

    def _address(self, target: e.Lvalue, frame: Frame) -> Value:
        """A place; that of an object is the object itself."""
        try:
            found = self.eval(target, frame)
        except (UnboundLocalError, KeyError):
            found = None
        if isinstance(found, Object):
            return found
        return self._place(target, frame)

    def _place(self, target: e.Lvalue, frame: Frame) -> Value:
        match target:
            case e.Local(name):
                held = frame.locals.get(name)
                if isinstance(held, Alias):
                    return held.pointer
                return Pointer(frame.locals, name, frame.function.name, "captured")
            case e.Temporary(number):
                return Pointer(frame.temporaries, number)
            case e.Captured(function, name):
                return Pointer(frame.around[function].locals, name, function, "captured")
            case e.Global(module, name):
                return Pointer(self.globals.setdefault(module, {}), name, module, "global")
            case e.Attribute(e.ClassReference(class_), name):
                return Pointer(self._static(class_).fields, name, class_, "attribute")
            case e.Attribute(holder, name):
                found = self.eval(holder, frame)
                return Pointer(found.fields, name, found, "attribute")
            case e.Index(holder, index):
                at, container = self.eval(index, frame), self.eval(holder, frame)
                return Pointer(container, at, container, "element")
            case e.Dereference(reference):
                return self.eval(reference, frame)
            case _:
                raise NotImplementedError(target)

    def _led_to(self, value: Value) -> Value:
        """What a pointer leads to; a value in an optional is there itself."""
        assert value is not None, "a null pointer"
        return self._read(value) if isinstance(value, Pointer) else value

    def _read(self, pointer: Pointer) -> Value:
        self._note_place("read", pointer)
        return pointer.read()

    def _write(self, pointer: Pointer, value: Value) -> None:
        self._note_place("write", pointer)
        pointer.write(value)

    def _note_place(self, how: str, pointer: Pointer) -> None:
        if pointer.owner is not None:
            self.note(f"{how} {pointer.kind}", pointer.owner, pointer.key)

    def _static(self, class_: str) -> Object:
        return self.statics.setdefault(class_, Object(class_))

    def global_(self, module: str, name: str) -> Value:
        if module in self.program.modules or not self.modules:
            return super().global_(module, name)
        self.note("read global", module, name)
        return self.globals[module][name]

    def _copy(self, value: Value, type_: t.Type) -> Value:
        """A value that shares nothing, but for what pointers in it lead to."""
        match type_:
            case t.Reference():
                return value
            case t.Container(t.ContainerKind.MAPPING, (_, of)):
                return {key: self._copy(each, of) for key, each in value.items()}
            case t.Container(t.ContainerKind.SET):
                return set(value)
            case t.Container(_, (of, *_)) | t.Array(of, _):
                return [self._copy(each, of) for each in value]
            case t.Optional(of):
                return None if value is None else self._copy(value, of)
            case _ if isinstance(value, Object):
                types = dict(self._field_types(value.class_name))
                copies = {
                    n: self._copy(v, types.get(n, t.UNKNOWN)) for n, v in value.fields.items()
                }
                return Object(value.class_name, copies)
            case _:
                return value

    def closure(self, expression: e.Closure, frame: Frame) -> Value:
        """A closure has own copies of what it takes by value."""
        if all(c.by_reference for c in expression.captures) and not expression.captures:
            return super().closure(expression, frame)
        spaces: dict[str, Captured] = {}
        for capture in expression.captures:
            variable = capture.variable
            is_own = isinstance(variable, e.Local)
            function = frame.function.name if is_own else variable.function  # type: ignore[union-attr]
            space = spaces.setdefault(function, Captured())
            if capture.by_reference:
                space.places[variable.name] = self._place(variable, frame)
            else:
                value = self.eval(variable, frame)
                space.own[variable.name] = self._copy(value, variable.type)
        function = self.program.function(expression.function)
        around = {
            name: Frame(function, {}, space)  # type: ignore[arg-type]
            for name, space in spaces.items()
        }

        def call(*arguments: Value) -> Value:
            names = [p.name for p in function.parameters]
            inner = Frame(function, around, dict(zip(names, arguments, strict=True)))
            return self._finish(self._function(inner))

        return call

    # --- statements ------------------------------------------------------------------------------

    def statement(self, statement: s.Statement, frame: Frame) -> Run:
        match statement:
            case s.Declare(e.Local(name), _, None):
                frame.locals.pop(name, None)
            case s.Declare(e.Local(name), _, value) if value is not None:
                frame.locals[name] = self.value(value, frame)
            case s.Declare(target, _, value) if not isinstance(target, e.Attribute):
                if value is not None:
                    self.store(target, self.value(value, frame), frame)
            case s.Construct(target, class_name, arguments, constructor):
                made = Object(class_name)
                self.store(target, made, frame)
                if constructor is not None:
                    taken = [self.value(a.value, frame) for a in arguments]
                    self._called(constructor, [made, *taken])
            case s.Destroy(target, class_name):
                self._destroy_at(target, class_name, frame)
            case s.Switch(value, cases):
                return (yield from self._switch(self.value(value, frame), cases, frame))
            case s.Unsequenced(parts):
                for part in reversed(parts) if self.is_reversed else parts:
                    jump = yield from self.body(part, frame)
                    if jump is not None:
                        return jump
            case s.ForEach() if statement.by_reference:
                return (yield from self._for_each_place(statement, frame))
            case _:
                return (yield from super().statement(statement, frame))
        return None

    def _switch(self, value: Value, cases: tuple[s.Case, ...], frame: Frame) -> Run:
        starts = [
            n for n, c in enumerate(cases) if any(self.value(v, frame) == value for v in c.values)
        ]
        starts = starts or [n for n, c in enumerate(cases) if c.is_default]
        for case in cases[starts[0] :] if starts else ():
            jump = yield from self.body(case.body, frame)
            if jump is not None:
                return None if jump.kind is s.Break else jump
        return None

    def _for_each_place(self, loop: s.ForEach, frame: Frame) -> Run:
        elements = self.value(loop.iterable, frame)
        assert isinstance(loop.target, e.Local)
        number = 0
        while number < len(elements):
            frame.locals[loop.target.name] = Alias(Pointer(elements, number, elements, "element"))
            number += 1
            jump: Jump | None = yield from self.body(loop.body, frame)
            if jump is not None and jump.kind is not s.Continue:
                return None if jump.kind is s.Break else jump
        return (yield from self.body(loop.otherwise, frame))

    def store(self, target: e.Lvalue | None, value: Value, frame: Frame) -> None:
        match target:
            case e.Local(name) if isinstance(frame.locals.get(name), Alias):
                self._write(frame.locals[name].pointer, value)
            case e.Global(module, name):
                self.note("write global", module, name)
                self.globals.setdefault(module, {})[name] = value
            case e.Attribute(e.ClassReference(class_), name) if class_ not in self.classes:
                self.note("write attribute", class_, name)
                self._static(class_).fields[name] = value
            case e.Attribute(holder, name) if isinstance(self.value(holder, frame), Object):
                found = self.value(holder, frame)
                self.note("write attribute", found, name)
                found.fields[name] = value
            case e.Index(holder, index) if isinstance(self.value(holder, frame), str):
                text, at = self.value(holder, frame), self.value(index, frame)
                self.store(holder, text[:at] + chr(value) + text[at + 1 :], frame)  # type: ignore[arg-type]
            case e.Dereference(reference):
                found = self.value(reference, frame)
                if isinstance(found, Object):
                    found.fields = value.fields
                else:
                    self._write(found, value)
            case _:
                super().store(target, value, frame)

    def call(self, name: str, *arguments: Value) -> Value:
        """A function of the program by its name."""
        return self._called(name, arguments)

    # --- calls -----------------------------------------------------------------------------------

    def _called(self, name: str, arguments: Value) -> Value:
        """Runs a function; while a constructor or destructor runs, the object is of its class."""
        function = self.program.function(name)
        names = [p.name for p in function.parameters]
        frame = Frame(function, {}, dict(zip(names, arguments, strict=True)))
        special = function.kind in (FunctionKind.CONSTRUCTOR, FunctionKind.DESTRUCTOR)
        if not special or function.owner is None:
            return self._finish(self._function(frame))
        object_ = arguments[0]
        before, object_.class_name = object_.class_name, function.owner
        try:
            return self._finish(self._function(frame))
        finally:
            object_.class_name = before

    def _callee(self, callee: s.Callee, frame: Frame) -> Value:
        match callee:
            case s.FunctionCallee(name):
                return lambda *arguments: self._called(name, arguments)
            case s.MethodCallee(receiver, name) if isinstance(self.value(receiver, frame), Object):
                object_ = self.value(receiver, frame)
                method = self._method(object_.class_name, name)
                return lambda *arguments: self._called(method, [object_, *arguments])
            case s.LibraryCallee("note"):
                return lambda value: self.notes.append(_shown(self._led_to(value)))
            case s.LibraryCallee(name, None) if name in FUNCTIONS:
                return FUNCTIONS[name]
            case s.LibraryCallee(name, receiver) if receiver is not None:
                return self._library_method(name, receiver, frame)
            case _:
                return super()._callee(callee, frame)

    def _library_method(self, name: str, receiver: e.Expression, frame: Frame) -> Value:
        held = self.value(receiver, frame)
        if name in METHODS:
            return lambda *arguments: METHODS[name](held, *arguments)
        if isinstance(held, str):
            return lambda *arguments: self._text(name, held, receiver, arguments, frame)
        raise NotImplementedError(name)

    def _text(
        self, name: str, held: str, receiver: e.Expression, arguments: Value, frame: Frame
    ) -> Value:
        """Texts of Python do not change: what a method makes of one is stored."""
        result, after = text_method(name.rpartition("::")[2], held, arguments)
        if after != held:
            assert isinstance(receiver, e.Lvalue)
            self.store(receiver, after, frame)
        return result

    # --- classes ---------------------------------------------------------------------------------

    def _lineage(self, name: str) -> Iterator[Class]:
        class_ = self.program.classes.get(name)
        if class_ is not None:
            yield class_
            for base in class_.bases:
                yield from self._lineage(base or "")

    def _method(self, class_name: str, name: str) -> str:
        return next(
            dict(c.methods)[name] for c in self._lineage(class_name) if name in dict(c.methods)
        )

    def _field_types(self, name: str) -> Iterator[tuple[str, t.Type]]:
        for class_ in self._lineage(name):
            for field in class_.fields:
                yield field.name, field.type

    def _destroy_at(self, target: e.Lvalue, class_name: str | None, frame: Frame) -> None:
        value = self.value(target, frame)
        if isinstance(value, Object) and class_name is not None:
            named = self.program.classes[class_name]
            is_virtual = named.virtual is not None and _DESTRUCTOR in named.virtual
            self._end(value, value.class_name if is_virtual else class_name)
        else:
            self._end_value(value, target.type)

    def _end(self, object_: Object, class_name: str) -> None:
        """The destructor, then the fields from the last to the first, then the bases."""
        class_ = self.program.classes.get(class_name)
        if class_ is None:
            return
        if class_.destructor is not None:
            self._called(class_.destructor, [object_])
        for field in reversed(class_.fields):
            if not field.is_shared and field.name in object_.fields:
                self._end_value(object_.fields[field.name], field.type)
        for base in reversed(class_.bases):
            self._end(object_, base or "")

    def _end_value(self, value: Value, type_: t.Type) -> None:
        match type_:
            case t.Record(name) if isinstance(value, Object):
                self._end(value, name)
            case t.Container(t.ContainerKind.MAPPING, (_, of)):
                for key in sorted(value):
                    self._end_value(value[key], of)
            case t.Container(_, (of, *_)) | t.Array(of, _):
                each = reversed(value) if isinstance(type_, t.Array) else iter(value)
                for element in each:
                    self._end_value(element, of)
            case t.Optional(of) if value is not None:
                self._end_value(value, of)
            case t.Reference(of, _, t.Ownership.UNIQUE) if isinstance(value, Object):
                name = value.class_name if self._ends_virtually(of) else of.name  # type: ignore[union-attr]
                self._end(value, name)

    def _ends_virtually(self, of: t.Type) -> bool:
        class_ = self.program.classes.get(of.name) if isinstance(of, t.Record) else None
        return class_ is not None and class_.virtual is not None and _DESTRUCTOR in class_.virtual

    # --- exceptions ------------------------------------------------------------------------------

    def _raise(self, raised: Value, cause: e.Expression | None, frame: Frame) -> None:
        if isinstance(raised, BaseException | type):
            super()._raise(raised, cause, frame)
        raise Thrown(raised)

    def _fits(self, handler: s.Handler, raised: BaseException, frame: Frame) -> bool:
        if isinstance(raised, NotImplementedError | AssertionError):
            return False  # of the interpreter, not of the program
        if not isinstance(raised, Thrown) or handler.types is None:
            return super()._fits(handler, raised, frame)
        return any(self._is_of(raised.value, kind) for kind in handler.types)

    def _is_of(self, value: Value, kind: e.Expression) -> bool:
        match kind:
            case e.ClassReference(name):
                own = value.class_name if isinstance(value, Object) else ""
                return any(c.name == name for c in self._lineage(own))
            case e.LibraryReference("int"):
                return isinstance(value, int)
            case _:
                return False

    def _handler(self, handler: s.Handler, raised: BaseException, frame: Frame) -> Run:
        if isinstance(raised, Thrown) and handler.target is not None:
            self.store(handler.target, raised.value, frame)
            return (yield from self.body(handler.body, frame))
        return (yield from super()._handler(handler, raised, frame))


def _same(left: Value, right: Value) -> bool:
    return left == right if isinstance(left, Pointer) else left is right


def _shown(value: Value) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)
