/* The part of LTSmin's public header ltsmin/pins-util.h that language modules of rebsync use. */
#ifndef PINS_UTIL
#define PINS_UTIL

#include <ltsmin/pins.h>

extern void pins_chunk_put_at(model_t model, int type_no, const chunk c, int index);
extern int pins_chunk_put(model_t model, int type_no, const chunk c);
extern chunk pins_chunk_get(model_t model, int type_no, int index);

#endif
