int calls = 0;
bool is_even(int k) {
  calls += 1;
  return k % 2 == 0;
}
int f(int a, int b) {
  calls = 0;
  bool both = is_even(a) && is_even(b);
  bool one = is_even(a) || is_even(b);
  return calls * 100 + (both ? 10 : 0) + (one ? 1 : 0);
}
