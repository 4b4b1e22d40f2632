/* Uses the installed support library of generated code from plain C. */
#include <sinew/math/sinew_math.h>

int main(void) { return 0; }
