/* The part of LTSmin's public header ltsmin/dlopen-api.h that language modules of rebsync use. */
#ifndef PINS_DLOPEN_API_H
#define PINS_DLOPEN_API_H

#include <ltsmin/pins.h>

extern void ltsmin_abort(int code) __attribute__((noreturn));
extern char pins_plugin_name[];
extern void pins_model_init(model_t model);

#endif
