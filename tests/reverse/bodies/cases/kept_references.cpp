// Objects that keep references to variables, by which these change later.
struct Holder {
  int& n;
};
using Pair = std::pair<int&, int>;
void onPair() {
  int i = 0;
  std::pair<int&, int> p(i, 1);
  for (; i < 3; ++i) p.first = 0;
}
void onTie() {
  int i = 0;
  auto t = std::tie(i);
  for (; i < 3; ++i) std::get<0>(t) = 0;
}
void onHeld() {
  int i = 0;
  Holder h{i};
  for (; i < 3; ++i) h.n = 0;
}
void onStoredLambda() {
  int i = 0;
  std::function<void()> again = [&i]() { i = 0; };
  for (; i < 3; ++i) again();
}
void onPointers() {
  int i = 0;
  std::vector<int*> v;
  v.push_back(&i);
  for (; i < 3; ++i) *v[0] = 0;
}
void onWrappers() {
  int i = 0;
  std::vector<std::reference_wrapper<int>> v{i};
  for (; i < 3; ++i) v[0].get() = 0;
}
void onView() {
  int i = 0;
  auto view = other::view_of(i);
  for (; i < 3; ++i) view.clear();
}
void onLent() {
  int i = 0;
  other::look_at(i);
  for (; i < 3; ++i) sensor_.poke(1);
}
void onLentEachRound() {
  for (int i = 0; i < 3; ++i) sensor_.add(other::shape_of(i));
}
void onMember() {
  std::pair<int&, int> p(count_, 1);
  p.first = 0;
}
void onAlias() {
  Pair p(count_, 1);
  p.first = 0;
}
void onWrapper() {
  std::reference_wrapper<int> p(count_);
  p.get() = 0;
}
void onSpan() {
  std::span<int> s(grid_);
  s[0] = 0;
}
void onAny() {
  std::span s(grid_);
  s[0] = 0;
}
void onNamed() {
  std::pair<std::reference_wrapper<int>, int> p(count_, 1);
  p.first.get() = 0;
}
void onLocal() {
  int i = 5;
  std::pair<int&, int> p(i, 1);
  p.first = 0;
  count_ = i;
}
void onCopies() {
  std::pair<int, double> p(count_, 1);
  std::function<void(int&)> f(count_);
}
