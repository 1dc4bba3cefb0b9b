// Messages: filled, copied, published.
void Node::onFilled() {
  std_msgs::Int32 m;
  m.data = count_ + 1;
  pub_.publish(m);
  std_msgs::Bool flag;
  flag.data = count_ > 3;
  flag_pub_.publish(flag);
  ping_pub_.publish(std_msgs::Empty());
  idle_pub_.publish(m);
}
void Node::onParts() {
  geometry_msgs::Twist twist;
  twist.linear.x = 0.5;
  twist.linear.y = 0.25;
  twist.angular.z = level_;
  twist_pub_.publish(twist);
  geometry_msgs::Twist stop;
  twist_pub_.publish(stop);
  twist_pub_.publish(geometry_msgs::Twist());
}
void Node::onPointers(const std_msgs::Int32::ConstPtr& msg) {
  std_msgs::Int32Ptr p(new std_msgs::Int32);
  p->data = msg->data;
  pub_.publish(p);
  auto q = boost::make_shared<std_msgs::Int32>();
  q->data = 3;
  pub_.publish(*q);
  pub_.publish(msg);
  pub_.publish(*msg);
}
void Node::onCopies(const std_msgs::Int32& msg) {
  kept_ = msg;
  pub_.publish(kept_);
  std_msgs::Int32 copy = kept_;
  copy.data++;
  kept_.data = copy.data;
  auto other = copy;
  pub_.publish(other);
}
void Node::onUnknown() {
  std_msgs::Bool b;
  b.data = sensor_.ready();
  flag_pub_.publish(b);
  std_msgs::Int32 m = sensor_.message();
  pub_.publish(m);
  std_msgs::Int32 n;
  n.data = sensor_.read();  // rebsync: domain 1..2
  pub_.publish(n);
  std_msgs::Int32 k;
  k.data = sensor_.read();
  pub_.publish(k);
}
