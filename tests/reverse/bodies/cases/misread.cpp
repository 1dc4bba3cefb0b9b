// What the grammar takes for casts and declarations.
void Node::onParentheses(const std_msgs::Int32::ConstPtr& msg) {
  limit_ = (count_) - 1;
  limit_ = 2 * (count_) - 1 * 3;
  limit_ = (msg->data) & limit_;
  if ((count_) & 1 == 0 && on_) limit_ = 0;
  limit_ = (std::abs(count_)) - 3;
  limit_ = (int)-1 + (count_) * (limit_);
  if (sensor_.far((count_) - 1)) on_ = true;
  archive_ & limit_;
  count_ = limit_;
}
void Node::onCast() {
  count_ = (int8_t)(limit_) - (count_) % -3;
  limit_ = (int)(int8_t)(count_) + 1;
  count_ = (int8_t)(limit_);
}
