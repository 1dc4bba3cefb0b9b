"""How generated C++ reads: plain names, and no parentheses around parentheses without need."""

from __future__ import annotations

import pytest

from tests.forward.compiling import CASES, case_files, generated


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-cpp"])
def test_parentheses_of_calls_enclose_operands(target: str) -> None:
    source = case_files(CASES / "parentheses.rebeca", target)["src/operands.cpp"]
    lines = [line.strip() for line in source.splitlines()]
    assert "a_ = divide(a_ + b_, k - 1);" in lines
    assert "c_ = static_cast<int8_t>(a_ + b_);" in lines
    assert 't_ = mailbox_.isA(x == kNull ? mailbox_.self() : x, "Operands");' in lines
    # What the model has though it need not, what might be arguments of a template, assignments.
    assert "a_ = divide((a_ * b_), k);" in lines
    assert "a_ = divide((a_ < b_ ? a_ : b_), (a_ > b_ ? 2 : k));" in lines
    assert "c_ = static_cast<int8_t>((a_ = 4));" in lines


@pytest.mark.parametrize(
    ("parameter", "held"),
    [("size", ("msg", "when")), ("msg", ("msg_", "when")), ("when", ("msg", "when_"))],
)
def test_helpers_leave_names_to_the_model(parameter: str, held: tuple[str, str]) -> None:
    msg, when = held
    model = (
        f"reactiveclass Reader(2) {{ msgsrv take(int {parameter}) {{ }} }}\n"
        "reactiveclass Writer(2) { knownrebecs { Reader reader; }\n"
        "msgsrv write() { reader.take(1) after(2); } }\n"
        "main { Reader reader():(); Writer writer(reader):(); }\n"
    )
    source = generated(model, "letters")["src/writer.cpp"]
    assert f"mailbox_.publish(reader_take_pub_, {msg}, {when});" in source
    assert f"::sendReaderTake(int32_t {parameter}, const When& {when}) {{" in source


@pytest.mark.parametrize("method", ["msg", "when", "recipient"])
def test_helpers_hide_no_function_of_the_class(method: str) -> None:
    model = (
        f"reactiveclass Writer(2) {{ int {method}() {{ return 1; }}\n"
        f"msgsrv put(Writer other, int by) {{ other.put(other, {method}()); }} }}\n"
        "main { Writer writer():(); }\n"
    )
    source = generated(model, "letters")["src/writer.cpp"]
    assert f"{method}_" in source.partition("::sendWriterPutTo(")[2].partition("\n}")[0]
