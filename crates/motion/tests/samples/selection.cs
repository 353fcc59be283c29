Get the records from where they are, 
 
one by one, 
 
and take care. 
 
Record Number 	 Record Sequence Number 	 Scale Factor 	 File Name Dir. 1 	 File Name Dir. 2 	 URL 1 	 URL 2 
1 	 7 	   1.25 	 EVENT\STA360.AT2 	 EVENT\STA090.AT2 	 here/EVENT\STA090.AT2 	 here/EVENT\STA090.AT2 
2 	 8 	   0.80 	 EVENT\STB360.AT2 	 EVENT\STB090.AT2 	 here/EVENT\STB090.AT2 	 here/EVENT\STB090.AT2 
