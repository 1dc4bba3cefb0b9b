// A library of which nobody can read the source; see README.md.
#ifndef FAKE_LIBRARY_H
#define FAKE_LIBRARY_H

#include <sstream>

namespace topic_tools {

int level();  // 0 to 5
bool ready();
double ratio();
void record(int value);
std::ostream& out();

struct Table {
  int& at(int index);
  int& operator()(int row, int column);
  Table& row(int index);
  int cell;
};
Table& table();

}  // namespace topic_tools

namespace Eigen {

struct Matrix3d {
  Matrix3d(int rows, int columns);
  double& operator()(int row, int column);
  double cell;
};

}  // namespace Eigen

#endif  // FAKE_LIBRARY_H
