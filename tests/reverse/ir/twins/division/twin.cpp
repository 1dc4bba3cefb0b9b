int f(int a, int b) { return a / b * 100 + a % b; }
