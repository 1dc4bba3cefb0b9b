#define SHOW(text) if (sensor_.loud()) { stream_ << text; }
#define SHOW_ALL(...) do { sensor_.show(__VA_ARGS__); } while (0)
#define NEXT(x) ++x
#define CLEAR(x) memset(&(x), 0, sizeof(x))
#define BOTH(x) stream_ << x; count_ = 0
#define LEAVES(x) if (sensor_.has(x)) return
#define GLUED(x) sensor_.show##x()
#define BRACES(x) stream_ << x; } if (on_) {
#ifndef OTHERS
#define OTHERS(x) stream_ << x
#endif
#ifdef LOUD
#define EITHER(x) stream_ << x
#else
#define EITHER(x) count_ = x
#endif
#define OUTER(x) SHOW(x)
#define ITSELF(x) ITSELF(x)

void Node::onMacros(const std_msgs::Int32::ConstPtr& msg) {
  SHOW("count " << count_ << " of " << limit_);
  SHOW(count_);
  OUTER("twice " << count_);
  count_ = msg->data;
  if (on_) {
    SHOW("on");
    count_ = 3;
  }
  SHOW(++count_);
  SHOW(sensor_.fill(count_));
  SHOW_ALL("a", 3);
  NEXT(count_);
  CLEAR(grid_);
  BOTH(count_);
  LEAVES(3);
  GLUED(count_);
  BRACES(count_);
  OTHERS(count_);
  EITHER(3);
  ITSELF(3);
}
void Node::onMatrices(const std_msgs::Int32::ConstPtr& msg) {
  matrix_(0, count_) = count_ * 2;
  matrix_(0, ++count_) = 2;
  count_ = msg->data;
  Eigen::Matrix<double, 3, 1> pose;
  Eigen::MatrixXd turned(3, 3);
  for (int i = 0; i < 3; ++i) {
    pose(i) = limit_;
    turned(i, count_) += pose(i);
  }
  if (pose(0) > 1.0) on_ = true;
  other_(count_);
  sensor_.at(count_) = 3;
  sensor_.at(++count_) = 3;
  sensor_.all().at(count_++).x = 3;
  matrix_.row(limit_++)(0) = 3;
  sensor_.fill(pose(0));
  std::function<int(int)> f = given();
  f(count_);
}
