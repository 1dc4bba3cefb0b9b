// Time, chance and checks.
class Node { void onTimes(); ros::Time last_; };
void Node::onTimes() {
  ros::Duration(2.0).sleep();
  ros::Duration d(3);
  d.sleep();
  sleep(count_);
  usleep(4000000);
  std::this_thread::sleep_for(std::chrono::milliseconds(5000));
  ros::Duration(0.5).sleep();
  last_ = ros::Time::now();
  if ((ros::Time::now() - last_).toSec() > 2.0) count_ = 0;
  if (ros::Time::now() - last_ > ros::Duration(5.0)) count_ = 1;
  level_ = (ros::Time::now() - last_).toSec();
  timer_ = nh_.createTimer(ros::Duration(2.0), &Node::tick, this, true);
  timer_ = nh_.createTimer(ros::Duration(2.0), &Node::tick, this);
}
void Node::onChance() {
  count_ = rand() % 3;
  limit_ = 1 + std::rand() % 2;
  level_ = rand() / 2.0;
}
void Node::onChecks() {
  ROS_ASSERT(count_ > 0);
  assert(limit_);
  ROS_ASSERT_MSG(count_ < 5, "many");
  assert(sensor_.ready());
}
void Node::onLibrary() {
  count_ = std::min(count_, 5);
  count_ = std::max(limit_, count_ + 1);
  count_ = std::abs(limit_ - 3);
  level_ = fabs(level_);
  count_ = std::min(std::max(count_, 0), 9);
  level_ = std::sqrt(level_) + pow(2, 3) + M_PI;
  count_ = grid_.size();
  if (std::isnan(level_)) count_ = INT_MAX;
}
void Node::onSpans() {
  last_.fromSec(3.0);
  last_ = ros::Time(2, 0) + ros::Duration(1.0);
  if (last_.isZero()) count_ = close(count_);
}
void Node::onSleepUntil() {
  ros::Time::sleepUntil(ros::Time::now() + ros::Duration(2));
}
