// Functions whose bodies stand in the place of their calls.
std_msgs::Int32 Node::made(int n) {
  std_msgs::Int32 m;
  m.data = n;
  return m;
}
void Node::send(const std_msgs::Int32& m) { pub_.publish(m); }
void Node::fill(std_msgs::Int32& m, int n) { m.data = n * 2; }
void Node::raise(int& n) { n++; }
int Node::sign(int n) {
  if (n < 0) return -1;
  if (n > 0) return 1;
  return 0;
}
bool Node::near() { return range_ < 0.5; }
int Node::twice(int n) { return n * 2; }
int Node::again(int n) { return n > 0 ? again(n - 1) : 0; }
void Node::onHelpers() {
  pub_.publish(made(count_));
  send(made(3));
  std_msgs::Int32 m;
  fill(m, count_);
  send(m);
  raise(count_);
  raise(grid_[1]);
  limit_ = sign(count_);
  if (near()) count_ = twice(limit_) + 1;
  bump();
  this->bump();
  limit_ = add(3) + add(count_ > 2);
  keep(m);
  limit_ = again(3);
  if (on_ && near()) count_ = 0;
  tick();
}
void Node::onLambdas() {
  auto bumped = [&](int n) { count_ += n; };
  bumped(3);
  const int most = [&] { return limit_ + 1; }();
  count_ = most;
}
void give(const ros::Publisher& p, int x) {
  std_msgs::Int32 out;
  out.data = x;
  p.publish(out);
}
void poke(Node& node) { node.count_ += 2; }
void prod(Node* node) { node->count_++; }
void Node::onHandedPublisher() {
  give(pub_, 3);
}
void Node::onHandedItself() {
  poke(*this);
  prod(this);
}
void Node::onEach() {
  for (auto p : sensor_.publishers()) {
    std_msgs::Int32 out;
    p.publish(out);
  }
}
