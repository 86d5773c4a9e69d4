// A learner in C: compiled as C11 against the public header alone.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/// Steps two environments of `task` `steps` times without an action. The sum of their rewards goes to `*sum`,
/// the library's text to `error`, which holds `size` characters; the library's code is returned.
int cClient(const char* task, int steps, double* sum, char* error, unsigned long size);

#ifdef __cplusplus
}
#endif
