// What touches nothing of the model is left out; what may touch it is listed.
void Node::onOutside() {
  ROS_INFO("count %d", count_);
  ROS_INFO_STREAM("count " << count_);
  std::cout << count_ << std::endl;
  printf("%d\n", count_);
  sensor_.reset(count_ + 1);
  sensor_.level = std::max(count_, 3);
  broadcaster_.sendTransform(tf::StampedTransform(t, ros::Time::now(), "a", "b"));
  std::lock_guard<std::mutex> lock(mutex_);
  if (count_ > 3) ROS_WARN("many");
  for (int i = 0; i < count_; ++i) sensor_.poke(i);
  file_ << count_ << "\n";
  cloud_.points.push_back(Point(1, 2));
  std::string name = "n" + std::to_string(count_);
  names_.push_back(name);
  range_ = level_;
  (void)count_;
  auto copy = sensor_.clone();
  copy.value = 3;
}
void Node::onTouches() {
  ROS_INFO("%d", ++count_);
  sensor_.fill(count_);
  sensor_.keep(&limit_);
  sensor_.keep(this);
  helper_.run();
  ros::shutdown();
  ros::spinOnce();
  client_.call(request_);
  throw std::runtime_error("no");
  std::for_each(a_.begin(), a_.end(), [&](int x) { count_ += x; });
  static int calls = 0;
  calls++;
  if (calls > 3) on_ = true;
  timer_.stop();
  goto end;
  int* p = &count_;
  *p = 3;
  try { count_ = 1; sensor_.read(); } catch (...) { count_ = 2; }
}
void Node::onLocalsHandedOut() {
  int n = 3;
  sensor_.fill(n);
  if (n > 3) on_ = true;
  int m = 3;
  sensor_.fill(+m);
  count_ = m;
}
void Node::onElements() {
  sensor_.change(grid_.at(1));
  std::fill(grid_.begin(), grid_.end(), 0);
  std::swap(count_, limit_);
  memset(grid_.data(), 0, 3);
  names_.push_back(count_);
  sensor_.change(std::move(kept_));
}
void Node::onHidden() {
  stream_ >> count_;
  archive_ & limit_;
  range_ = count_ >> 1;
  sensor_();
  sensor_(count_ + 1);
  if (sensor_(range_) > 3) on_ = true;
  names_.at(0).append(text_);
}
void Node::onAlternatives() {
#if DEBUG
  sensor_.trace();
#endif
#ifdef FAST
  count_ = 2;
#else
  count_ = 1;
#endif
}
int& Node::chosen() { return count_; }
void Node::onReferences() {
  (on_ ? count_ : limit_) = 0;
  ++(on_ ? count_ : limit_);
  int& r = on_ ? count_ : limit_;
  r = 5;
  chosen() = 3;
  int& c = chosen();
  c = 4;
  sensor_.list()[count_] = 3;
  *sensor_.place() = count_;
  sensor_[count_].x++;
}
void Node::onRead() {
  read(3, grid_, 12);
}
void Node::onWaits() {
  select(2, set_, nullptr, nullptr, &wait_);
  ::poll(files_, 1, 100);
  sensor_.poll();
}
int count_;
