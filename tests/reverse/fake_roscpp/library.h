// A library of which nobody can read the source; see README.md.
#ifndef FAKE_LIBRARY_H
#define FAKE_LIBRARY_H

namespace library {

int level();  // 0 to 5
bool ready();
double ratio();
void record(int value);

}  // namespace library

#endif  // FAKE_LIBRARY_H
