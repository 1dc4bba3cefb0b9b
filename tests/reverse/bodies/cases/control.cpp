// Loops, branches and returns.
constexpr int kMost = 4;
void Node::onEarlyReturn(const std_msgs::Int32::ConstPtr& msg) {
  if (msg->data < 0) return;
  if (msg->data == 0) {
    count_ = 0;
    return;
  } else if (msg->data > kMost)
    count_ = kMost;
  else
    count_ = msg->data;
}
void Node::onLoops() {
  for (int i = 0; i < 3; ++i) {
    if (grid_[i] == 2) continue;
    count_ += grid_[i];
  }
  for (auto x : grid_) count_ += x;
  for (int& x : grid_) x = 0;
  for (const auto& x : grid_) {
    if (x > 2) break;
    limit_ = x;
  }
  for (int k : {1, 2, 5}) count_ += k;
  do {
    count_--;
  } while (count_ > 0 && on_);
  do { limit_ = 0; } while (0);
  while (ros::ok() && count_ < 3) count_++;
}
void Node::onSwitch() {
  switch (mode_) {
    case RED:
      count_ = 1;
      break;
    case GREEN: {
      count_ = 2;
    } break;
    case Mode::FAST:
    default:
      count_ = 3;
  }
  limit_ = on_ ? count_ : 0;
  on_ ? bump() : keep(kept_);
  count_ = 1, limit_ = 2;
}
void Node::onEndless() {
  for (;;) {
    if (count_ > 2) break;
    ++count_;
  }
}
void Node::onDefaultFirst() {
  switch (count_) {
    default:
      limit_ = 1;
      break;
    case 2:
      limit_ = 2;
  }
  switch (count_) {
    default:
      limit_ = 1;
    case 2:
      limit_ = 2;
  }
}
void Node::onContinueInDo() {
  int left = 3;
  do {
    if (on_) continue;
    count_++;
  } while (--left > 0);
}
void Node::onGuards(const std_msgs::Int32& msg) {
  msg.data > 5 && (count_ = 9);
  on_ || bump();
  on_ && limit_ && count_--;
  (void)(count_ += 2);
  (limit_ = 4);
  limit_ > 3 && msg.data;
  count_++ > 3;
}
void Node::onAlias() {
  Node* self = this;
  self->count_ = 5;
  Node& me = *this;
  me.bump();
  auto that = this;
  that->limit_++;
}
void Node::onAliasUnseen() {
  for (const auto& entry : sensor_.list()) {
    Node* self = this;
    self->count_ = entry.x;
  }
}
