class Robot {
 public:
  explicit Robot(int speed) : speed_(speed), moves_(0) {}
  void move(int by) {
    if (speed_ + by > 10) return;
    speed_ += by;
    ++moves_;
  }
  int state() { return speed_ * 100 + moves_; }
 private:
  int speed_;
  int moves_;
};
int f(int start, int by) {
  Robot robot(start);
  robot.move(by);
  robot.move(by);
  return robot.state();
}
