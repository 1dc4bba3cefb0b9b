/* A search by so many threads, as a program by itself: what watches threads can look at it.
 *
 *     together tts|ftts|core THREADS
 *
 * Prints `states transitions events`. */
#include "runtime.c"

extern const struct model rebsync_model;

static void go_on(int *goes_on)
{
    *goes_on = 1;
}

int main(int count, char **arguments)
{
    if (count != 3)
        return 2;
    int view = arguments[1][0] == 't' ? TTS : arguments[1][0] == 'f' ? FTTS : CORE;
    int32_t asked[64] = {0}, predicates = rebsync_model.predicates < 64 ? rebsync_model.predicates : 64;
    for (int32_t i = 0; i < predicates; i++)
        asked[i] = i;
    struct search *s = rebsync_new(&rebsync_model, view, 0, asked, predicates, asked, 0);
    if (!s || !rebsync_team(s, (uint32_t)atoi(arguments[2]), view, asked, 0))
        return 3;
    rebsync_watch(s, go_on);
    int end = SLICE;
    while (end == SLICE)
        end = rebsync_search(s, UINT64_MAX, NEVER, INT64_MAX, 1000000);
    struct figures f;
    rebsync_figures(s, &f);
    rebsync_free(s);
    printf("%ju %ju %ju\n", (uintmax_t)f.states, (uintmax_t)f.transitions, (uintmax_t)f.events);
    return end != FINISHED;
}
