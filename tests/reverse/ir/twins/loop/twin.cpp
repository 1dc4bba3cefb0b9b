int f(int n) {
  int total = 0;
  for (int i = 0; i < n; ++i) {
    if (i % 3 == 0) continue;
    if (total > 50) break;
    total += i;
  }
  return total;
}
