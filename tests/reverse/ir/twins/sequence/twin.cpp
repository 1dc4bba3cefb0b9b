#include <vector>
int f(int k) {
  std::vector<int> values = {3, 1, 2};
  values.push_back(k);
  int total = 0;
  for (int value : values) total = total * 10 + value;
  values[0] = 9;
  return total + values[0] * static_cast<int>(values.size());
}
