// Fields of messages that are narrower, or wider, than what the model has for them.
std_msgs::UInt8 made(int value) {
  std_msgs::UInt8 m;
  m.data = value;
  return m;
}
void fill(std_msgs::UInt8& m, int value) { m.data = value; }
void Node::onOctets() {
  std_msgs::UInt8 m;
  m.data = count_;
  octet_pub_.publish(m);
  std_msgs::UInt8 copy = m;
  copy.data += limit_;
  octet_pub_.publish(copy);
  copy = m;
  copy.data = small_;
  copy.data--;
  octet_pub_.publish(copy);
  octet_pub_.publish(made(count_));
  fill(m, limit_);
  octet_pub_.publish(m);
  m.data = on_;
  octet_pub_.publish(m);
}
void Node::onTruths() {
  std_msgs::Bool m;
  m.data = count_;
  flag_pub_.publish(m);
  m.data = count_ > 2 ? 1 : 0;
  flag_pub_.publish(m);
}
void Node::onWideFields() {
  std_msgs::Int64 m;
  m.data = count_;
  m.data *= 3;
  count_ = m.data;
}
void Node::onNumbersWithoutSign() {
  unsigned rest = count_;
  if (rest > 0) limit_ = 3;
  unsigned left = count_;
  if (left > 0) limit_ = 1;
  if (left - 1 > 3) limit_ = 2;
  left = left % 4u;
  unsigned sure = 3;
  while (sure > 0) sure--;
  limit_ = sure / 2;
  int64_t sum = limit_;
  sum += 7;
  level_ = sum * 2;
}
void Node::onOrders() {
  unsigned u = limit_;
  if (count_ < u) limit_ = 1;
  if (u >= 7) limit_ = 2;
  size_t few = 3;
  if (few > count_) limit_ = 3;
  if (count_ == few) limit_ = 4;
  long signed_too = 3;
  if (count_ < signed_too) limit_ = 5;
  size_t any = limit_;
  if (count_ < any) limit_ = 6;
}
