#include <map>
#include <string>
int f(int k) {
  std::map<int, int> table = {{1, 10}, {2, 20}};
  int value = table.count(k) ? table[k] + 1 : 5;
  table[k] = value;
  int total = 0;
  for (const auto& [key, value] : table) total += key * value;
  return total;
}
