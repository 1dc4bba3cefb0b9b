/* Rounds: the next states of a level, expanded by all threads of a team.
 *
 * What a round leaves is what one thread would have left that had expanded the same states: the
 * same states under the same numbers, the same steps that have led to them, and the same events. So
 * candidates are looked up, stored and judged in the order of the steps that make them. Whatever
 * ends a search in the middle of a round (a violation, a bound, a body that does not end) ends it
 * at the same step: the round leaves nothing then, and one thread expands its states.
 *
 * Numbers of local states are those of one kernel (kernel.h). States are stored in the numbers of the
 * search's kernel, to which nothing happens while threads run; each worker has a kernel of its own.
 */
#ifndef REBSYNC_ROUNDS_H
#define REBSYNC_ROUNDS_H

#include "storing.h"
#include "team.h"

/* --- numbers of local states in two kernels */

static uint32_t looked_up(const struct vector *numbers, uint32_t number)
{
    return number < numbers->count ? ((uint32_t *)numbers->data)[number] : NONE;
}

static void put_name(struct escape *out, struct vector *numbers, uint32_t number, uint32_t other)
{
    size_t known = numbers->count;
    uint32_t *data = room_for(out, numbers, (size_t)number + 1, sizeof *data);
    if (number >= known) {
        memset(data + known, 255, (number + 1 - known) * sizeof *data);
        numbers->count = (size_t)number + 1;
    }
    data[number] = other;
}

static void put_names(struct escape *out, struct names *n, uint32_t own, uint32_t common)
{
    put_name(out, &n->own, common, own);
    put_name(out, &n->common, own, common);
}

/* The worker's number of a local state that the search's kernel knows. */
static uint32_t own_number(struct worker *w, uint32_t rebec, uint32_t common)
{
    const unsigned char *content;
    uint32_t own = looked_up(&w->names[rebec].own, common);
    if (own != NONE)
        return own;
    kernel_content(w->search->kernel, rebec, common, &content);
    own = kernel_number(w->kernel, rebec, content);
    if (own == NONE)
        give_up(w->escape);
    put_names(w->escape, w->names + rebec, own, common);
    return own;
}

/* The search's number of a local state that a worker knows; only while no thread runs. */
static uint32_t common_number(struct search *s, struct worker *w, uint32_t rebec, uint32_t own)
{
    const unsigned char *content;
    uint32_t common = looked_up(&w->names[rebec].common, own);
    if (common != NONE)
        return common;
    kernel_content(w->kernel, rebec, own, &content);
    common = kernel_number(s->kernel, rebec, content);
    if (common == NONE)
        give_up(s->escape);
    put_names(s->escape, w->names + rebec, own, common);
    return common;
}

/* Packs a state of a worker; 0 when the search's kernel does not know all of it. */
static int pack_own(struct worker *w, const uint32_t *ids, uint64_t *words)
{
    for (uint32_t r = 0; r < w->search->rebecs; r++) {
        w->common[r] = looked_up(&w->names[r].common, ids[r]);
        if (w->common[r] == NONE)
            return 0;
    }
    pack(w->search, w->common, words);
    return 1;
}

static struct candidate *candidate(struct worker *w, size_t i)
{
    return (struct candidate *)w->candidates.data + i;
}

static uint32_t *candidate_ids(struct worker *w, size_t i)
{
    return (uint32_t *)w->states.data + i * w->search->rebecs;
}

/* --- first phase: steps of the states, without those to states that are known */

/* Leaves the candidates that the table does not have. */
static void look_up(struct worker *w)
{
    struct search *s = w->search;
    size_t kept = w->looked_up, first = kept;
    for (size_t i = first; i < w->candidates.count; i++) {
        const struct candidate *c = candidate(w, i);
        const uint64_t *words = (uint64_t *)w->words.data + (i - first) * s->words;
        if (c->named && s->table[find(s, words, c->hash)])
            continue;
        if (kept < i) {
            *candidate(w, kept) = *c;
            memcpy(candidate_ids(w, kept), candidate_ids(w, i), s->rebecs * sizeof(uint32_t));
        }
        kept++;
    }
    w->candidates.count = w->states.count = w->looked_up = kept;
}

static void gather_state(struct worker *w, const struct transition *step, int64_t time)
{
    struct search *s = w->search;
    if (step->code > UINT32_MAX)
        give_up(w->escape);
    if (w->candidates.count == w->looked_up + BATCH)
        look_up(w);
    size_t i = w->candidates.count;
    struct candidate *c = added(w->escape, &w->candidates, sizeof *c);
    uint32_t *ids = added(w->escape, &w->states, s->rebecs * sizeof *ids);
    uint64_t *words = (uint64_t *)w->words.data + (i - w->looked_up) * s->words;
    memcpy(ids, step->state, s->rebecs * sizeof *ids);
    *c = (struct candidate){.time = time,
                            .parent = (uint32_t)w->parent,
                            .code = (uint32_t)step->code,
                            .deadlock = step->deadlock != 0};
    if (!pack_own(w, ids, words))
        return;
    c->named = 1;
    c->hash = hash_words(s, words);
    __builtin_prefetch(s->table + slot_of(s, c->hash));
}

/* Takes in a step that a worker's kernel has made. */
static void gather_step(void *worker, const struct transition *step)
{
    struct worker *w = worker;
    struct search *s = w->search;
    int64_t parent = (int64_t)w->parent, time = step->time;
    if (step->state && s->until != NEVER) {
        time += ((int64_t *)s->times.data)[parent];
        if (time > s->until) {
            w->dropped++;
            return;
        }
    }
    w->transitions++;
    if (step->state)
        gather_state(w, step, time);
    else
        note(w->judge, (struct event){step->kind, step->pc, step->rebec, parent, (int64_t)step->code});
}

static void expand_own(struct worker *w, uint64_t state)
{
    struct search *s = w->search;
    size_t made;
    unpack(s, words_of(s, state), w->common);
    for (uint32_t r = 0; r < s->rebecs; r++)
        w->ids[r] = own_number(w, r, w->common[r]);
    w->parent = state;
    expect(w->escape, kernel_successors(w->kernel, w->ids, 1, &made, gather_step, w));
}

/* The next chunk of the round; those that are taken are the first ones. The first always is. */
static struct chunk *next_chunk(struct worker *w)
{
    struct team *t = w->search->team;
    int over = clock_now() >= t->due || w->candidates.count * w->search->rebecs > GATHERED;
    if (over && t->next)
        t->enough = 1;
    if (t->enough)
        return NULL;
    uint64_t number = t->next++;
    return number < t->chunk_count ? t->chunks + number : NULL;
}

static void expand_chunks(struct worker *w)
{
    struct team *t = w->search->team;
    room_for(w->escape, &w->words, BATCH * (size_t)w->search->words, sizeof(uint64_t));
    for (struct chunk *c; (c = next_chunk(w));) {
        uint64_t state = t->first + (uint64_t)(c - t->chunks) * CHUNK;
        *c = (struct chunk){.worker = w, .first = w->candidates.count};
        for (uint64_t i = 0; i < CHUNK && state < t->end; i++)
            expand_own(w, state++);
        look_up(w);
        c->count = w->candidates.count - c->first;
        if (w->judge->violated)
            t->enough = 1;
    }
}

/* --- between phases: names and places */

static void name_chunk(struct search *s, const struct chunk *chunk)
{
    struct worker *w = chunk->worker;
    for (size_t i = chunk->first; i < chunk->first + chunk->count; i++)
        if (!candidate(w, i)->named)
            for (uint32_t r = 0; r < s->rebecs; r++)
                common_number(s, w, r, candidate_ids(w, i)[r]);
}

/* Names all, and gives all a place behind the states; 0 when there are too many. */
static int lay_out_round(struct search *s)
{
    struct team *t = s->team;
    uint64_t place = s->count;
    for (uint64_t i = 0; i < t->taken; i++) {
        name_chunk(s, t->chunks + i);
        t->chunks[i].place = place;
        place += t->chunks[i].count;
    }
    if (place >= NONE - 2)
        return 0;
    if (s->wide)
        repack(s);
    room_for(s->escape, &s->states, place * s->words * sizeof(uint64_t), 1);
    room_for(s->escape, &s->parents, place, sizeof(uint32_t));
    if (s->until != NEVER)
        room_for(s->escape, &s->times, place, sizeof(int64_t));
    return 1;
}

/* --- second phase: packed, where all see them */

static void place_chunks(struct worker *w)
{
    struct search *s = w->search;
    memset(w->owned, 0, s->shares * sizeof *w->owned);
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        if (chunk->worker != w)
            continue;
        for (size_t i = 0; i < chunk->count; i++) {
            struct candidate *c = candidate(w, chunk->first + i);
            uint64_t *words = words_of(s, chunk->place + i);
            pack_own(w, candidate_ids(w, chunk->first + i), words);
            c->hash = hash_words(s, words);
            w->owned[kernel_owner(c->hash, s->shares)]++;
        }
    }
}

static void fill_own_share(struct worker *w)
{
    fill_share(w->search, w->number);
}

static int some_share_is_full(struct search *s)
{
    for (uint32_t share = 0; share < s->shares; share++) {
        uint64_t more = 0;
        for (uint32_t i = 0; i < s->team->workers; i++)
            more += s->team->worker[i].owned[share];
        if (is_full(s, share, more))
            return 1;
    }
    return 0;
}

static void room_for_round(struct search *s)
{
    while (some_share_is_full(s)) {
        make_table(s, larger_table(s));
        all_do(s, fill_own_share);
    }
}

/* --- third phase: into the table, each worker into its share */

static void insert_own(struct worker *w)
{
    struct search *s = w->search;
    w->inserted = 0;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++)
        for (size_t i = 0; i < chunk->count; i++) {
            struct candidate *c = candidate(chunk->worker, chunk->first + i);
            if (kernel_owner(c->hash, s->shares) != w->number)
                continue;
            uint64_t place = chunk->place + i;
            c->slot = find(s, words_of(s, place), c->hash);
            c->fresh = !s->table[c->slot];
            if (!c->fresh)
                continue;
            s->table[c->slot] = tag_of(s, c->hash) | (uint32_t)(place + 1);
            w->inserted++;
        }
}

/* Takes all of them out again, and nothing that came earlier can have been behind them. */
static void take_out(struct search *s)
{
    struct team *t = s->team;
    for (struct chunk *chunk = t->chunks; t->inserted && chunk < t->chunks + t->taken; chunk++)
        for (size_t i = 0; i < chunk->count; i++) {
            const struct candidate *c = candidate(chunk->worker, chunk->first + i);
            if (c->fresh)
                s->table[c->slot] = 0;
        }
    t->inserted = 0;
}

/* --- fourth phase: judged under their numbers among the candidates */

static void judge_chunks(struct worker *w)
{
    struct search *s = w->search;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        if (chunk->worker != w)
            continue;
        for (size_t i = chunk->first; i < chunk->first + chunk->count; i++) {
            const struct candidate *c = candidate(w, i);
            chunk->fresh += c->fresh;
            if (c->fresh && is_asked(s))
                judge(w->judge, candidate_ids(w, i), (int64_t)i);
            if (c->fresh && c->deadlock)
                note_deadlock(w->judge, (int64_t)i);
        }
    }
}

/* --- fifth phase: stored under their numbers */

static void store_chunks(struct worker *w)
{
    struct search *s = w->search;
    for (struct chunk *chunk = s->team->chunks; chunk < s->team->chunks + s->team->taken; chunk++) {
        uint64_t number = chunk->number;
        for (size_t i = chunk->first; chunk->worker == w && i < chunk->first + chunk->count; i++) {
            struct candidate *c = candidate(w, i);
            if (!c->fresh)
                continue;
            pack_own(w, candidate_ids(w, i), words_of(s, number));
            ((uint32_t *)s->parents.data)[number] = c->parent;
            if (s->until != NEVER)
                ((int64_t *)s->times.data)[number] = c->time;
            s->table[c->slot] = tag_of(s, c->hash) | (uint32_t)(number + 1);
            c->number = (uint32_t)number++;
        }
    }
}

/* --- what the workers have found out */

/* An event, and the step at which one thread would have met it. */
struct met {
    struct event event;
    int64_t parent, code;
    size_t order; /* of those of one step */
};

static int compare_met(const void *one, const void *other)
{
    const struct met *a = one, *b = other;
    if (a->parent != b->parent)
        return a->parent < b->parent ? -1 : 1;
    if (a->code != b->code)
        return a->code < b->code ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

static void gather_events(struct search *s, struct worker *w)
{
    for (size_t i = 0; i < w->judge->events.count; i++) {
        struct event e = ((struct event *)w->judge->events.data)[i];
        struct met met = {e, e.state, e.ordinal, i};
        if (e.ordinal < 0) { /* of a candidate */
            const struct candidate *c = candidate(w, (size_t)e.state);
            met.parent = c->parent;
            met.code = c->code;
            met.event.state = c->number;
        }
        *(struct met *)added(s->escape, &s->team->met, sizeof met) = met;
    }
}

static void note_all(struct search *s)
{
    struct vector *all = &s->team->met;
    all->count = 0;
    for (uint32_t i = 0; i < s->team->workers; i++)
        gather_events(s, s->team->worker + i);
    if (all->count)
        qsort(all->data, all->count, sizeof(struct met), compare_met);
    for (size_t i = 0; i < all->count; i++)
        note(s->judge, ((struct met *)all->data)[i].event);
}

static int64_t number_of_candidate(struct worker *w, int64_t i)
{
    return i < 0 ? -1 : (int64_t)candidate(w, (size_t)i)->number;
}

/* The extremes of a worker's states put together with those of others; states of earlier rounds have
 * lower numbers. */
static void join_measured(struct worker *w, struct measured *m, const struct measured *found)
{
    int64_t least = number_of_candidate(w, found->least_state);
    int64_t greatest = number_of_candidate(w, found->greatest_state);
    int64_t undefined = number_of_candidate(w, found->undefined);
    int less = m->least_state < 0 || found->least < m->least ||
               (found->least == m->least && least < m->least_state);
    int more = m->greatest_state < 0 || found->greatest > m->greatest ||
               (found->greatest == m->greatest && greatest < m->greatest_state);
    if (least >= 0 && less) {
        m->least = found->least;
        m->least_state = least;
    }
    if (greatest >= 0 && more) {
        m->greatest = found->greatest;
        m->greatest_state = greatest;
    }
    if (undefined >= 0 && (m->undefined < 0 || undefined < m->undefined))
        m->undefined = undefined;
}

static void forget_round(struct search *s)
{
    for (uint32_t i = 0; i < s->team->workers; i++) {
        struct worker *w = s->team->worker + i;
        w->candidates.count = w->states.count = w->looked_up = 0;
        w->transitions = w->dropped = 0;
        w->judge->events.count = 0;
        w->judge->violated = 0;
        measure_nothing(w->judge);
    }
}

/* All that the workers know of the round becomes part of the search; what can fail comes first. */
static void complete_round(struct search *s, uint64_t fresh)
{
    struct team *t = s->team;
    note_all(s);
    t->inserted = 0;
    s->count += fresh;
    s->parents.count = s->count;
    s->times.count = s->until == NEVER ? 0 : s->count;
    s->expanded += t->taken * CHUNK < t->end - t->first ? t->taken * CHUNK : t->end - t->first;
    for (uint32_t i = 0; i < t->workers; i++) {
        struct worker *w = t->worker + i;
        s->taken[i] += w->inserted;
        s->transitions += w->transitions;
        s->dropped += w->dropped;
        for (int32_t m = 0; m < s->model->measures; m++)
            join_measured(w, s->judge->measured + m, w->judge->measured + m);
        kernel_covered(w->kernel, w->served, w->covered, w->largest);
    }
}

/* --- a round */

static void begin_round(struct search *s, int64_t due)
{
    struct team *t = s->team;
    uint64_t left = s->level_end - s->expanded;
    t->first = s->expanded;
    t->end = t->first + (left < ROUND ? left : ROUND);
    t->chunk_count = (t->end - t->first + CHUNK - 1) / CHUNK;
    t->next = t->enough = t->stop = t->refused = t->inserted = 0;
    t->due = due;
    if (s->wide)
        repack(s);
}

/* Whether the round has to be left to one thread: it ends the search, or would end it at once. */
static int is_spoilt(struct search *s)
{
    for (uint32_t i = 0; i < s->team->workers; i++)
        if (s->team->worker[i].answer != COMPLETE || s->team->worker[i].judge->violated)
            return 1;
    return 0;
}

static uint64_t number_chunks(struct team *t, uint64_t count)
{
    uint64_t number = count;
    for (uint64_t i = 0; i < t->taken; i++) {
        t->chunks[i].number = number;
        number += t->chunks[i].fresh;
    }
    return number - count;
}

/* One round; 0 when it is left to one thread. */
static int make_round(struct search *s, uint64_t states, int64_t due)
{
    struct team *t = s->team;
    begin_round(s, due);
    all_do(s, expand_chunks);
    t->taken = t->next < t->chunk_count ? t->next : t->chunk_count;
    if (is_spoilt(s) || !lay_out_round(s))
        return 0;
    all_do(s, place_chunks);
    room_for_round(s);
    t->inserted = 1;
    all_do(s, insert_own);
    all_do(s, judge_chunks);
    uint64_t fresh = number_chunks(t, s->count);
    if (is_spoilt(s) || s->count + fresh >= states)
        return 0;
    all_do(s, store_chunks);
    complete_round(s, fresh);
    return 1;
}

/* What became of an attempt to expand states together. */
enum attempt { DECLINED, EXPANDED, REFUSED };

/* Lets the team expand the next states, if they are enough to be worth it. */
static enum attempt expand_together(struct search *s, uint64_t states, int64_t due)
{
    struct team *t = s->team;
    if (!t || t->disbanded || s->expanded < t->alone || s->level_end - s->expanded < WORTH)
        return DECLINED;
    flush(s);
    struct escape outside = *s->escape;
    int escaped = setjmp(s->escape->to), done = 0;
    if (!escaped) {
        if (start_threads(t))
            done = make_round(s, states, due);
        else
            disband(t);
    }
    *s->escape = outside;
    if (escaped || !done)
        take_out(s);
    if (escaped == NO_MEMORY)
        disband(t);
    if (!s->table)
        fill_table(s, s->slots);
    if (t->disbanded)
        return DECLINED;
    forget_round(s);
    t->alone = done || t->refused ? 0 : t->first + ROUND;
    return t->refused ? REFUSED : done ? EXPANDED : DECLINED;
}

#endif
