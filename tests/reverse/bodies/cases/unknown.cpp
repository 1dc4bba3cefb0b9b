// Values that the model cannot know.
void Node::onConditions() {
  if (range_ < 0.5) count_ = 1;
  if (on_ && sensor_.ready()) count_ = 2;
  if (!sensor_->near(count_ + 1)) count_ = 3; else count_ = 4;
  on_ = found_;
  on_ = std::getenv("X") != nullptr;
  bool seen = sensor_.seen();
  if (seen && count_ > 2) count_ = 0;
  limit_ = seen ? 1 : 2;
}
void Node::onDomains() {
  count_ = sensor_.read();  // rebsync: domain 0..3
  // rebsync: domain {1, 2, 7}
  limit_ = std::stoi(text_);
  level_ = range_;  // rebsync: domain {0.5, 1.5}
  count_ = sensor_.read();
  count_ += sensor_.read();
}
void Node::onLocals() {
  double nearest = 100.0;
  int at = 0;
  for (size_t i = 0; i < scan_.ranges.size(); ++i) {
    if (scan_.ranges[i] < nearest) {
      nearest = scan_.ranges[i];
      at = i;
    }
  }
  if (nearest < 1.0) count_++;
  limit_ = at;
}
void Node::onSwitched() {
  switch (sensor_.key()) {
    case 'w': count_ = 1; break;
    case 's': count_ = 2; break;
  }
}
void Node::onLoop() {
  while (sensor_.busy()) count_++;
  for (auto& p : sensor_.points()) limit_++;
}
void Node::onTransform() {
  tf::StampedTransform t;
  try {
    listener_.lookupTransform("a", "b", ros::Time(0), t);
    count_ = 1;
  } catch (const tf::TransformException& e) {
    ROS_ERROR("%s", e.what());
    return;
  }
  limit_ = 3;
}
void Node::onDomainOfMember() {
  rank_ = sensor_.read();
  rank_ = count_;
  int local = sensor_.read();  // rebsync: domain 7..8
  count_ = local;
}
