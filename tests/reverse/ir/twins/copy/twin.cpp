struct Point {
  int x;
  int y;
};
int f(int k) {
  Point a{k, 2};
  Point b = a;
  Point& c = a;
  b.x += 10;
  c.y += 5;
  return a.x * 1000 + a.y * 100 + b.x * 10 + b.y;
}
