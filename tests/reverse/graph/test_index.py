"""What the index of declarations has of people's code."""

from __future__ import annotations

from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import inside, parse, text_of
from rebsync.source import Source

_TEXT = """
#define LIMIT 8
namespace a {
class NODE_EXPORT Outer : public b::Base<int>, Other {
 public:
  enum Mode { OFF, ON = 4, BLINK, OTHER = sizeof(int), LAST };
  struct Inner { int depth = 3, *next; };
  typedef std_msgs::Int32 Message;
  void declared(int x = 2);
  int one, two = 2, *pointer, &reference, list[4];
  const double fixed_;
  static const int COUNT = 5;
};
template <typename T>
void Outer::Inner::method(T x) {}
template <typename T>
T Table<T>::get() const { return T(); }
}
using Twist = geometry_msgs::Twist;
static int counter = 1, *where;
const std::string NAME("x");
int a::Outer::shared = 6;
enum class Kind : uint8_t { FIRST = 1, SECOND };
"""


def _code() -> Code:
    return Code.of([parse(Source("a.h", _TEXT))])


def test_classes_inside_of_classes_are_apart() -> None:
    code = _code()
    assert set(code.classes) == {"Outer"}
    assert [c.outer for c in code.all_classes["Inner"]] == ["Outer"]
    assert code.classes["Outer"].bases == ("Base", "Other")


def test_members_have_their_own_values() -> None:
    outer = _code().classes["Outer"]
    values = {f.name: text_of(f.value) if f.value else None for f in outer.fields}
    assert values == {"one": None, "two": "2"}
    assert {f.name for f in outer.others} == {"pointer", "reference", "list", "fixed_", "COUNT"}


def test_functions_belong_to_the_last_class_before_their_name() -> None:
    assert {("Inner", "method"), ("Table", "get")} <= set(_code().definitions)


def test_enumerators_have_values_as_far_as_numbers_say_them() -> None:
    code = _code()
    found = {n: (e[0].enum, e[0].scope, e[0].value) for n, e in code.enumerators.items()}
    assert found == {
        "OFF": ("Mode", "Outer", 0),
        "ON": ("Mode", "Outer", 4),
        "BLINK": ("Mode", "Outer", 5),
        "OTHER": ("Mode", "Outer", None),
        "LAST": ("Mode", "Outer", None),
        "FIRST": ("Kind", "", 1),
        "SECOND": ("Kind", "", 2),
    }


def test_variables_constants_and_other_names_for_types() -> None:
    code = _code()
    assert set(code.variables) == {"counter", "where", "NAME"}
    assert {name for _, name in code.constants} == {"LIMIT", "COUNT", "NAME"}
    assert [text_of(v.value) for v in code.statics.values() if v.value] == ["6"]
    assert set(code.statics) == {("Outer", "shared")}
    assert {name: text_of(a[0].type) for name, a in code.aliases.items()} == {
        "Message": "std_msgs::Int32",
        "Twist": "geometry_msgs::Twist",
    }


def test_a_node_is_found_in_its_file_whatever_is_in_view() -> None:
    one, other = (parse(Source(f"{n}.cpp", f"\n int {n} = 1;")) for n in ("one", "other"))
    code = Code.of([one, other])
    (value,) = inside(other.root, "number_literal")
    assert code.view([one]).file_of(value) is other
