// What the scripts of a page share, which come after this one.
'use strict';

// A button; `act` is given it when it is pressed.
function button(text, title, act) {
  const made = document.createElement('button');
  made.type = 'button';
  made.textContent = text;
  made.title = title;
  made.addEventListener('click', () => act(made));
  return made;
}
