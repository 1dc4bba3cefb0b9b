int f(int k) {
  int total = 1;
  auto add = [&total, k](int by) {
    total += by * k;
    return total;
  };
  int first = add(2);
  int second = add(3);
  return first * 1000 + second * 10 + total;
}
