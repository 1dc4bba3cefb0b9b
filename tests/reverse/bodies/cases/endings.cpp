// Loops that change nothing of the model: those that end are outside, of others nothing is known.
void onEnding(const LaserScan& scan) {
  for (size_t i = 0; i < scan.ranges.size(); ++i) ROS_INFO("%f", scan.ranges[i]);
  for (int i = 0; i < 3; ++i) sensor_.poke(i);
  for (auto it = values_.begin(); it != values_.end(); ++it) sensor_.put(*it);
  while (!waiting_.empty()) {
    sensor_.put(waiting_.front());
    waiting_.pop_front();
  }
  do {
    sensor_.reset();
  } while (0);
  std::string text = "5";
  size_t left = text.size();
  while (left-- > 0) sensor_.put(left);
}
void onCalled() {
  while (sensor_.busy()) sensor_.reset();
}
void onStored(const LaserScan& scan) {
  for (size_t i = 0; i < values_.size(); ++i) values_.push_back(2);
}
void onRead() {
  std::string text;
  size_t left = text.size();
  while (left > 0) sensor_.read(&left);
}
void onRefilled() {
  while (!waiting_.empty()) {
    waiting_.pop_front();
    waiting_.push_back(1);
  }
}
void onStreamed() {
  std::string text;
  for (size_t i = 0; i < text.size(); ++i) stream_ >> i;
}
void onLambda() {
  for (int i = 0; i < 3; ++i) {
    auto again = [&i]() { i = 0; };
    again();
  }
}
std::vector<int> values_;
std::deque<int> waiting_;
Sensor sensor_;
std::istringstream stream_;
