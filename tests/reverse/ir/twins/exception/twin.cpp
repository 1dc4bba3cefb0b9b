struct Failure {
  int code;
};
int risky(int k) {
  if (k > 2) throw Failure{k};
  return k * 2;
}
int f(int k) {
  try {
    return risky(k) + 1;
  } catch (const Failure& failure) {
    return failure.code * 100;
  }
}
