// Read with bodies in place of the declarations' semicolons: the object then has the names of all
// functions that the declarations promise.

#include "allHeaders.h"
