#include "env/c_client.h"

#include <stdio.h>
#include <stdlib.h>

#include "nonet/env/nonet_env.h"

_Static_assert(sizeof(nonet_env_code) == sizeof(int),
               "codes are ints, also for those who call without a header");

static int play(nonet_env* env, int steps, double* sum) {
  nonet_env_sizes sizes;
  int code = nonet_env_get_sizes(env, &sizes);
  if (code != NONET_ENV_OK) return code;
  const size_t action_count = sizes.envs * sizes.actions;
  const size_t observation_count = sizes.envs * sizes.observations;
  float* actions = calloc(action_count, sizeof(float));
  float* observations = calloc(observation_count, sizeof(float));
  float* rewards = calloc(sizes.envs, sizeof(float));
  uint8_t* ends = calloc(2 * sizes.envs, 1);
  code = nonet_env_reset(env, 1, observations, observation_count);
  *sum = 0.0;
  for (int i = 0; i < steps && code == NONET_ENV_OK; ++i) {
    code = nonet_env_step(env, actions, action_count, observations, observation_count, rewards, ends,
                          ends + sizes.envs, sizes.envs);
    for (size_t k = 0; k < sizes.envs; ++k) *sum += rewards[k];
  }
  free(actions);
  free(observations);
  free(rewards);
  free(ends);
  return code;
}

int cClient(const char* task, int steps, double* sum, char* error, unsigned long size) {
  nonet_env_options options;
  nonet_env* env = NULL;
  int code = nonet_env_default_options(&options);
  options.task = task;
  options.envs = 2;
  options.quick = 1;
  if (code == NONET_ENV_OK) code = nonet_env_create(&options, &env);
  if (code == NONET_ENV_OK) code = play(env, steps, sum);
  snprintf(error, size, "%s", nonet_env_last_error());
  nonet_env_destroy(env);
  return code;
}
