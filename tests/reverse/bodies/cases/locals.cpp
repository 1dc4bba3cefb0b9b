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
