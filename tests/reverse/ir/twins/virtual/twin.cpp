struct Shape {
  virtual int area(int k) { return k; }
  int twice(int k) { return 2 * area(k); }
};
struct Square : Shape {
  int area(int k) override { return k * k; }
};
int f(int k) {
  Shape shape;
  Square square;
  return shape.twice(k) * 1000 + square.twice(k);
}
