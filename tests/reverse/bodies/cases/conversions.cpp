// What C++ converts unasked.
void Node::onNumbersAsTruth() {
  if (count_) limit_ = 1;
  if (!count_ && level_) limit_ = 2;
  on_ = count_;
  on_ = 3;
  count_ = on_;
  count_ += on_ == (limit_ > 2);
  while (count_ - 3) count_--;
}
void Node::onWidths() {
  small_ = 300;
  small_ = count_ + 1;
  small_ += 200;
  small_++;
  tiny_ = count_;
  tiny_ += 1;
  count_ = level_;
  count_ += 0.5;
  count_ = 2.0;
  half_ = 0.5;
  half_ = level_ * 2;
  level_ = count_ / 2;
  level_ = count_ * 0.5;
  count_ = (int)level_ % 5;
  count_ = int(level_) + static_cast<int8_t>(count_) + (uint8_t)count_;
}
void Node::onWideTypes() {
  size_t n = count_;
  uint32_t big{5};
  for (size_t i = 0; i < 3; ++i) count_ += grid_[i];
  unsigned int more = n + big;
  limit_ = (long)more;
}
void Node::onCounting() {
  level_++;
  --level_;
  half_++;
  limit_ = small_++;
  count_ = std::max({count_, 2, limit_});
  int a[4] = {1, 2};
  bool b[3] = {on_};
  limit_ = a[3] + b[0];
  limit_ = on_ ? count_ : on_;
}
void Node::onElements() {
  for (uint8_t x : grid_) count_ += x;
  for (bool x : grid_) count_ += x;
  for (uint8_t x : {1, 300}) count_ += x;
}
