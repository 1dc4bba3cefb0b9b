int count = 0;
struct Guard {
  Guard() { count += 1; }
  ~Guard() { count += 10; }
};
int f(int k) {
  count = 0;
  {
    Guard guard;
    if (k > 2) return count;
    count *= 2;
  }
  return count;
}
