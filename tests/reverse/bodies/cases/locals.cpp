// Locals of all kinds.
void Node::onLocals() {
  auto n = count_ + 1;
  const auto half = level_ / 2;
  int k(3), j{4}, z{};
  int& alias = count_;
  alias += k;
  const int& same = limit_;
  auto& cell = grid_[1];
  cell = j;
  int a[3] = {1, 2, 3};
  std::array<int, 2> b{{1, 2}};
  std::vector<int> v = {4, 5};
  std::vector<bool> w(3, false);
  count_ = a[0] + b[1] + v.at(1) + same + n + z;
  on_ = w[2] or not on_;
  int count = 5;
  limit_ = count;
  {
    int count = 6;
    limit_ += count;
  }
  std::string text = "x";
  if (int got = count_ * 2) limit_ = got;
  if (const int idx = 3; idx > count_) limit_ = idx;
  level_ = half;
  int msgsrv = 1;
  limit_ = msgsrv;
}
void Node::onCopiedCaptures() {
  int lim = 2;
  auto before = [lim]() { return lim; };
  lim = count_;
  limit_ = before() * 10 + lim;
  uint8_t octet = 3;
  auto all = [=] { return octet; };
  octet += 254;
  count_ = all();
  auto keeps = [lim]() mutable { return ++lim; };
  lim = 5;
  count_ = keeps();
}
void Node::onUnwrittenResults() {
  auto most = [](int x) {
    if (x > 3) return 3;
    return x;
  };
  limit_ = most(count_);
  auto found = [&](int x) {
    if (x > 3) return on_;
    return x < 2;
  };
  on_ = found(count_);
  auto own = [&](int x) {
    if (x > 3) {
      uint8_t x = 4;
      return x;
    }
    return x;
  };
  limit_ = own(count_);
}
void Node::onEither() {
  auto& chosen = on_ ? count_ : limit_;
  chosen = 7;
  limit_ += 1;
}
void Node::onSwaps() {
  std::swap(count_, limit_);
  std::swap(grid_[0], limit_);
}
