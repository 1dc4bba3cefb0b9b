struct Counter {
  static int all;
  int own = 0;
  void hit() {
    own += 1;
    all += 1;
  }
};
int Counter::all = 0;
int f(int k) {
  Counter::all = k;
  Counter a;
  Counter b;
  a.hit();
  b.hit();
  b.hit();
  return Counter::all * 100 + a.own * 10 + b.own;
}
