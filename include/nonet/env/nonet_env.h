// The trials of `nonet env` as a library for people who learn by reinforcement: a batch of environments on
// the exact server that step together. Plain C (C11); scripts/nonet_env.py is the same for Python.
//
//   nonet_env_options options;
//   nonet_env_default_options(&options);
//   options.task = "run";
//   options.envs = 8;
//   nonet_env* env = NULL;
//   if (nonet_env_create(&options, &env) != NONET_ENV_OK) puts(nonet_env_last_error());
//
// Arrays belong to the caller and are read and written during the call only; they hold 32-bit floats, row by
// row, environment by environment. With every array goes the count of its numbers, which must be the right
// one.
//
// Functions that can fail return a nonet_env_code; nonet_env_last_error() then says what is wrong. No
// function throws or ends the program. A call that is refused for its arguments changes nothing.
//
// Threads: several batches may be used at once, each by one thread at a time. A step is itself spread over
// `threads` threads. The first call of nonet_env_create() sets the level of the process's default spdlog
// logger to warnings; nothing else is global.
//
// The same seed and actions give the same numbers, however many threads there are and whatever the batch has
// done before: those of `nonet env` with the same options.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NONET_ENV_API __attribute__((visibility("default")))

// Rises when a program that was built with this header would not work with another library.
#define NONET_ENV_VERSION 1

typedef enum nonet_env_code {
  NONET_ENV_OK = 0,
  NONET_ENV_BAD_ARGUMENT = 1,  // a null pointer, a wrong count, an unknown task or parameter, ...
  NONET_ENV_NO_DATA = 2,       // params/ or skills/ are missing, wholly or in part
  NONET_ENV_FAILED = 3         // all else; the batch goes on after a reset
} nonet_env_code;

// A batch: made by nonet_env_create(), owned by the caller, who gives it to nonet_env_destroy().
typedef struct nonet_env nonet_env;

typedef struct nonet_env_options {
  size_t struct_size;  // of this struct, as nonet_env_default_options() sets it
  const char* task;    // a name of nonet_env_task_name(); there is no default
  uint64_t seed;       // of all episodes
  int32_t envs;        // environments in the batch, 1 to 10000
  int32_t threads;     // 0: as many as there are processors; at most 1024, and never more than environments
  int32_t robot_type;  // 0 to 4
  int32_t quick;       // not 0: the quick stepper instead of the exact one
  // The folder with params/ and skills/. NULL or "": that of the environment variable NONET_DATA, otherwise
  // the nearest one above this library, itself or in share/nonet, otherwise the source tree.
  const char* data_folder;
  const char* const* parameters;  // assignments such as "motion.walk.gait.maxStepX=5cm"; may be NULL if 0
  size_t parameter_count;
} nonet_env_options;

typedef struct nonet_env_sizes {
  size_t envs;
  size_t observations;      // numbers an environment shows
  size_t actions;           // numbers an environment takes; beyond -1 to 1 they count as those
  double seconds_per_step;  // s
} nonet_env_sizes;

// NONET_ENV_VERSION of the library.
NONET_ENV_API int nonet_env_version(void);

// What went wrong in this thread's last call that failed: never NULL, valid until the next one that fails.
NONET_ENV_API const char* nonet_env_last_error(void);

// Name and description of each task, in lasting memory; NULL for an index beyond the last task's.
NONET_ENV_API const char* nonet_env_task_name(size_t index);
NONET_ENV_API const char* nonet_env_task_description(size_t index);

// One environment, seed 1, all processors, robot type 0, the exact stepper; no task.
NONET_ENV_API nonet_env_code nonet_env_default_options(nonet_env_options* options);

// Makes a batch whose first episodes have begun; `*env` is NULL if it fails. Nothing of `options` is kept.
NONET_ENV_API nonet_env_code nonet_env_create(const nonet_env_options* options, nonet_env** env);

// NULL is allowed.
NONET_ENV_API void nonet_env_destroy(nonet_env* env);

NONET_ENV_API nonet_env_code nonet_env_get_sizes(const nonet_env* env, nonet_env_sizes* sizes);

// All environments begin their first episodes of `seed`, as in a batch made with it: envs x observations
// numbers are written.
NONET_ENV_API nonet_env_code nonet_env_reset(nonet_env* env, uint64_t seed, float* observations,
                                             size_t observation_count);

// One decision of every environment. Reads envs x actions numbers, none of which may be NaN; writes envs x
// observations numbers and, for each of `env_count` environments, its reward and whether its episode has
// ended: `terminated` is 1 if by what happened, `truncated` is 1 if only because its time was up, else 0. An
// episode that has ended is followed by the next at once: the observations are those of its beginning.
NONET_ENV_API nonet_env_code nonet_env_step(nonet_env* env, const float* actions, size_t action_count,
                                            float* observations, size_t observation_count, float* rewards,
                                            uint8_t* terminated, uint8_t* truncated, size_t env_count);

// The observations of the last step, but for an episode that it has ended that episode's last: what is needed
// to value an episode whose time was up.
NONET_ENV_API nonet_env_code nonet_env_final_observations(const nonet_env* env, float* observations,
                                                          size_t observation_count);

#ifdef __cplusplus
}  // extern "C"
#endif
